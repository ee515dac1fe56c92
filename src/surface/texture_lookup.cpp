#include "surface/texture_lookup.h"

#include <Imath/ImathVec.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include <cstring>

#include "core/error.h"
#include "signal/resize.h"
#include "surface/surface_module.h"

namespace gramloom::surface_module {

namespace {

// A picture and its halves, down to one pixel: the mean of the area under each.
std::vector<Image> mip_levels(const Image& picture) {
  std::vector<Image> levels{picture};
  while (levels.back().width > 1 || levels.back().height > 1) {
    const Image& last = levels.back();
    levels.push_back(resize(last, {std::max(1, last.width / 2), std::max(1, last.height / 2)}));
  }
  return levels;
}

constexpr const char* levels_attribute = "gramloom:levels";

// Pictures in memory as OpenImageIO's cache reads files. It opens one with the address of its
// levels among its options.
class LevelsInput : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "gramloom"; }
  bool valid_file(const std::string&) const override { return true; }
  bool open(const std::string& name, OIIO::ImageSpec& spec) override {
    return open(name, spec, OIIO::ImageSpec());
  }
  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& options) override {
    const OIIO::ParamValue* given = options.find_attribute(levels_attribute);
    if (!given) return false;
    std::memcpy(&levels_, given->data(), sizeof levels_);
    return seek_subimage(0, 0) && (spec = m_spec, true);
  }
  int current_miplevel() const override { return level_; }
  bool seek_subimage(int subimage, int level) override {
    if (subimage != 0 || level < 0 || level >= static_cast<int>(levels_->size())) return false;
    level_ = level;
    const Image& image = at(level);
    m_spec = OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeFloat);
    // For environment lookups; others don't look at it.
    m_spec.attribute("textureformat", "LatLong Environment");
    m_spec.attribute("oiio:updirection", "y");
    return true;
  }
  bool read_native_scanline(int, int level, int y, int, void* data) override {
    const Image& image = at(level);
    std::memcpy(data, image.at(0, y),
                sizeof(float) * static_cast<std::size_t>(image.width) *
                    static_cast<std::size_t>(image.channels));
    return true;
  }
  bool close() override { return true; }

 private:
  const Image& at(int level) const { return (*levels_)[static_cast<std::size_t>(level)]; }

  const std::vector<Image>* levels_ = nullptr;
  int level_ = 0;
};

OIIO::ImageInput* make_input() { return new LevelsInput; }

OIIO::TextureOpt::Wrap wrap_of(Outside outside) {
  switch (outside) {
    case Outside::tile:
      return OIIO::TextureOpt::WrapPeriodic;
    case Outside::mirror:
      return OIIO::TextureOpt::WrapMirror;
    case Outside::clamp:
      return OIIO::TextureOpt::WrapClamp;
    case Outside::colour:
      return OIIO::TextureOpt::WrapBlack;
  }
  return OIIO::TextureOpt::WrapPeriodic;
}

OIIO::TextureOpt options_of(Lookup lookup, Outside outside) {
  OIIO::TextureOpt options;
  options.swrap = options.twrap = wrap_of(outside);
  options.mipmode =
      lookup == Lookup::filtered ? OIIO::TextureOpt::MipModeAniso : OIIO::TextureOpt::MipModeNoMIP;
  options.interpmode = lookup == Lookup::nearest   ? OIIO::TextureOpt::InterpClosest
                       : lookup == Lookup::bicubic ? OIIO::TextureOpt::InterpBicubic
                                                   : OIIO::TextureOpt::InterpBilinear;
  options.anisotropic = 16;
  return options;
}

class SystemLookup : public TextureLookup {
 public:
  SystemLookup(const Image& picture, Lookup lookup, Outside outside)
      : channels_(picture.channels),
        levels_(lookup == Lookup::filtered ? mip_levels(picture) : std::vector<Image>{picture}),
        options_(options_of(lookup, outside)),
        system_(OIIO::TextureSystem::create(false)) {
    // A level is one tile, so that no lookup has to find another: all of it stays in memory.
    system_->attribute("autotile", 0);
    system_->attribute("automip", 0);
    system_->attribute("max_memory_MB", 1e6f);
    system_->attribute("max_errors_per_file", 1);
    OIIO::ImageSpec levels;
    const auto* address = &levels_;
    levels.attribute(levels_attribute, OIIO::TypeDesc::PTR, &address);
    const OIIO::ustring name("picture");
    system_->imagecache()->add_file(name, make_input, &levels);
    handle_ = system_->get_texture_handle(name, nullptr);
    if (!handle_ || !system_->good(handle_)) {
      const std::string why = system_->geterror();
      OIIO::TextureSystem::destroy(system_);
      throw Error("a picture cannot be looked up: {}", why);
    }
    read_all();
  }
  ~SystemLookup() override { OIIO::TextureSystem::destroy(system_); }
  SystemLookup(const SystemLookup&) = delete;
  SystemLookup& operator=(const SystemLookup&) = delete;

  void at(std::span<const Footprint> places, std::span<float> values) const override {
    auto* const thread = system_->get_perthread_info();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Footprint& p = places[i];
      OIIO::TextureOpt options = options_;
      // Rows go down the picture.
      system_->texture(handle_, thread, options, p.at.u, 1 - p.at.v, p.width.u, -p.width.v,
                       p.height.u, -p.height.v, channels_,
                       &values[i * static_cast<std::size_t>(channels_)]);
    }
  }

  void along(std::span<const Cone> cones, std::span<Vec3> values) const override {
    auto* const thread = system_->get_perthread_info();
    for (std::size_t i = 0; i < cones.size(); ++i) {
      const Vec3& d = cones[i].direction;
      const Tangents across = tangents(d);
      const Vec3 x = across.x * cones[i].width, y = across.y * cones[i].width;
      OIIO::TextureOpt options = options_;
      float colour[3]{};
      // OpenImageIO's pictures have +z in their middle and −x to its right.
      system_->environment(handle_, thread, options, Imath::V3f(-d.x, d.y, -d.z),
                           Imath::V3f(-x.x, x.y, -x.z), Imath::V3f(-y.x, y.y, -y.z), 3, colour);
      values[i] = {colour[0], colour[1], colour[2]};
    }
  }

 private:
  // Reads all levels while there is one thread: what threads see while others still read a level
  // depends on which comes first.
  void read_all() const {
    std::vector<float> texel(static_cast<std::size_t>(channels_));
    for (int level = 0; level < static_cast<int>(levels_.size()); ++level) {
      OIIO::TextureOpt options = options_;
      system_->get_texels(handle_, nullptr, options, level, 0, 1, 0, 1, 0, 1, 0, channels_,
                          OIIO::TypeFloat, texel.data());
    }
  }

  int channels_;
  std::vector<Image> levels_;
  OIIO::TextureOpt options_;
  OIIO::TextureSystem* system_;
  OIIO::TextureSystem::TextureHandle* handle_ = nullptr;
};

}  // namespace

std::unique_ptr<TextureLookup> lookup(const Image& picture, Lookup lookup, Outside outside) {
  return std::make_unique<SystemLookup>(picture, lookup, outside);
}

}  // namespace gramloom::surface_module
