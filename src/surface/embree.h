#pragma once

// Embree 3 (Debian 12) or 4 (Debian 13): the calls that differ.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace gramloom::surface_module {

#if RTC_VERSION_MAJOR < 4
inline RTCIntersectContext context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return context;
}
#endif

/// Eight rays side by side; `valid` is −1 for those that count.
inline void intersect(RTCScene scene, const int* valid, RTCRayHit8& rays) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect8(valid, scene, &rays);
#else
  RTCIntersectContext c = context();
  rtcIntersect8(valid, scene, &c, &rays);
#endif
}

/// tfar becomes negative where anything is in the way.
inline void occluded(RTCScene scene, const int* valid, RTCRay8& rays) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded8(valid, scene, &rays);
#else
  RTCIntersectContext c = context();
  rtcOccluded8(valid, scene, &c, &rays);
#endif
}
inline void occluded(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext c = context();
  rtcOccluded1(scene, &c, &ray);
#endif
}

}  // namespace gramloom::surface_module
