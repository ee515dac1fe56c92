#include "learnt/export_glsl.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "io/json_text.h"
#include "learnt/noise.h"

namespace gramloom {

namespace {

constexpr int most_targets = 4;  // of a pass: what WebGL 2 promises

int groups_of(int channels) { return (channels + 3) / 4; }

constexpr const char* explanation = R"(
 A pass is this text behind "#version 300 es" and "#define PASS k" (or only what stands before the first
 "#if PASS", and its own "#if"), drawn over the whole of layers [first, first + count) of the texture that
 it writes (RGBA32F, EXT_color_buffer_float), row 0 of the picture first. Uniforms besides the textures:
   seed           of the picture: 32 bits
   origin         place in the level of the first pixel that is written
   coarserOrigin  the same of the coarser level's picture
   whole          where the picture tiles: the level's size, half of the next finer one's, rounded up; else 0
   coarserWhole   the same of the next coarser level, also of the first
 The finest level's picture is the picture, from place 0 on. A level with its border goes from place a to
 place b; the next coarser one's picture from place between(a) to between(b) + 1, where between(x) =
 floor(((2 x + 1) coarser - fine) / (2 fine)) with these sizes, or with 1 and 2 where nothing tiles. */
)";

constexpr const char* common = R"(
precision highp float;
precision highp int;
precision highp sampler2DArray;
uniform sampler2DArray values, coarser, enlarged;
uniform uint seed;
uniform ivec2 origin, coarserOrigin, whole, coarserWhole;

// Rounded down.
int divided(int a, int b) {
  int q = int(floor(float(a) / float(b)));
  while (q * b > a) --q;
  while (a - q * b >= b) ++q;
  return q;
}
uint place(int x, int size) { return uint(size == 0 ? x : x - size * divided(x, size)); }
vec4 noise(int w) {
  ivec2 at = ivec2(gl_FragCoord.xy) + origin;
  uvec4 v = uvec4(place(at.x, whole.x), place(at.y, whole.y), seed, w) * 1664525u + 1013904223u;
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  v ^= v >> 16;
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  return vec4(v >> 8) * (2.0 * 1.7320508 / 16777216.0) - 1.7320508;
}
// The coarser pixel before x, and how much nearer x is to the next.
int between(int x, int size, int coarserSize, out float share) {
  int fine = size == 0 ? 2 : size, coarse = size == 0 ? 1 : coarserSize;
  int above = (2 * x + 1) * coarse - fine, before = divided(above, 2 * fine);
  share = float(above - 2 * fine * before) / float(2 * fine);
  return before;
}
vec4 twiceAsLarge(int layer) {
  ivec2 at = ivec2(gl_FragCoord.xy) + origin;
  vec2 share;
  ivec2 from = ivec2(between(at.x, whole.x, coarserWhole.x, share.x),
                     between(at.y, whole.y, coarserWhole.y, share.y)) - coarserOrigin;
  vec4 left = mix(texelFetch(coarser, ivec3(from, layer), 0),
                  texelFetch(coarser, ivec3(from + ivec2(0, 1), layer), 0), share.y);
  vec4 right = mix(texelFetch(coarser, ivec3(from + ivec2(1, 0), layer), 0),
                   texelFetch(coarser, ivec3(from + ivec2(1, 1), layer), 0), share.y);
  return mix(left, right, share.x);
}
vec4 at(int dx, int dy, int layer) {
  return texelFetch(values, ivec3(ivec2(gl_FragCoord.xy) + ivec2(dx, dy), layer), 0);
}
)";

std::string numbers(const std::vector<float>& values) {
  std::string text;
  for (const float value : values) {
    if (!text.empty()) text += ',';
    text += float_constant(value);
  }
  return text;
}

// Passes, and the textures between them, as they are written.
class Shaders {
 public:
  explicit Shaders(const PlainGenerator& generator) : generator_(generator) {
    for (int k = 0; k < generator.level_count(); ++k) add_level(k);
    add_picture();
  }

  const std::string& text() const { return text_; }
  const Json& textures() const { return textures_; }
  const Json& passes() const { return passes_; }

 private:
  using Body = std::function<std::string(int first, int count)>;

  // As many passes as its layers need. `body` assigns out0, out1, … for layers from `first` on.
  void add(const std::string& name, int level, int border, int layers, const Json& reads,
           const Body& body) {
    textures_[name] = {{"level", level}, {"border", border}, {"layers", layers}};
    for (int first = 0; first < layers; first += most_targets) {
      const int count = std::min(most_targets, layers - first);
      text_ += fmt::format("#if PASS == {}\n", passes_.size());
      for (int i = 0; i < count; ++i)
        text_ += fmt::format("layout(location = {}) out vec4 out{};\n", i, i);
      text_ += "void main() {\n" + body(first, count) + "}\n#endif\n";
      passes_.push_back({{"reads", reads}, {"writes", name}, {"first", first}, {"count", count}});
    }
  }

  void add_level(int k) {
    const PlainLevel& level = generator_.levels[static_cast<std::size_t>(k)];
    const auto border = static_cast<int>(level.layers.size());
    const int pictures = k > 0 ? groups_of(generator_.channels) : 0;
    const std::string input = fmt::format("input{}", k);
    const auto picture = [](int level_) { return fmt::format("level{}", level_); };
    add(input, k, border, pictures + level.noise / 4,
        k > 0 ? Json{{"coarser", picture(k - 1)}} : Json::object(), [&](int first, int count) {
          std::string body;
          for (int i = 0; i < count; ++i)
            body += first + i < pictures
                        ? fmt::format("  out{} = twiceAsLarge({});\n", i, first + i)
                        : fmt::format("  out{} = noise({});\n", i,
                                      noise_groups_per_level * k + first + i - pictures);
          return body;
        });
    std::string values = input;
    for (int i = 0; i < border; ++i) {
      const PlainLayer& layer = level.layers[static_cast<std::size_t>(i)];
      const std::string next = fmt::format("hidden{}_{}", k, i);
      add(next, k, border - 1 - i, groups_of(layer.outputs), {{"values", values}},
          [&](int first, int count) {
            std::string body = sums(layer, first, count, i == 0 && k > 0);
            for (int o = 0; o < count; ++o)
              body += fmt::format("  out{0} = max(s{0}, {1} * s{0}){2};\n", o,
                                  float_constant(leaky_slope),
                                  i == 0 ? "" : fmt::format(" + at(1, 1, {})", first + o));
            return body;
          });
      values = next;
    }
    Json reads{{"values", values}};
    if (k > 0) reads["enlarged"] = input;
    add(picture(k), k, 0, groups_of(generator_.channels), reads, [&](int first, int count) {
      std::string body = sums(level.out, first, count, false);
      for (int o = 0; o < count; ++o)
        body += k == 0 ? fmt::format("  out{0} = s{0};\n", o)
                       : fmt::format(
                             "  out{0} = s{0} + texelFetch(enlarged, "
                             "ivec3(ivec2(gl_FragCoord.xy) + {1}, {2}), 0);\n",
                             o, border, first + o);
      return body;
    });
  }

  void add_picture() {
    const int channels = generator_.channels, last = generator_.level_count() - 1;
    const PlainLayer colours{channels, channels, 1, generator_.axes, generator_.mean};
    add("picture", last, 0, groups_of(channels), {{"values", fmt::format("level{}", last)}},
        [&](int first, int count) {
          std::string body = sums(colours, first, count, false);
          for (int o = 0; o < count; ++o)
            body += fmt::format("  out{0} = clamp(s{0}, vec4({1}), vec4({2}));\n", o,
                                numbers(four(generator_.low, first + o)),
                                numbers(four(generator_.high, first + o)));
          return body;
        });
  }

  static std::vector<float> four(const std::vector<float>& values, int group) {
    std::vector<float> four(4, 0.0f);
    for (std::size_t i = 0; i < 4; ++i)
      if (const std::size_t c = static_cast<std::size_t>(group) * 4 + i; c < values.size())
        four[i] = values[c];
    return four;
  }

  // s0, s1, …: what the layer makes of `values`. Behind a picture its noise begins at a layer of
  // its own.
  std::string sums(const PlainLayer& layer, int first, int count, bool picture_first) const {
    const int gap = picture_first ? 4 * groups_of(generator_.channels) - generator_.channels : 0;
    const auto weight = [&](int output, int input, int tap) {
      if (picture_first && input >= generator_.channels) {
        if (input < generator_.channels + gap) return 0.0f;
        input -= gap;
      }
      return output < layer.outputs && input < layer.inputs ? layer.weight(output, input, tap)
                                                            : 0.0f;
    };
    std::string text = "  vec4 v";
    for (int o = 0; o < count; ++o)
      text += fmt::format(", s{} = vec4({})", o, numbers(four(layer.bias, first + o)));
    text += ";\n";
    for (int tap = 0; tap < layer.kernel * layer.kernel; ++tap)
      for (int group = 0; group < groups_of(layer.inputs + gap); ++group) {
        text +=
            fmt::format("  v = at({}, {}, {});\n", tap % layer.kernel, tap / layer.kernel, group);
        for (int o = 0; o < count; ++o) {
          std::vector<float> matrix;  // by columns
          for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
              matrix.push_back(weight(4 * (first + o) + j, 4 * group + i, tap));
          text += fmt::format("  s{} += mat4({}) * v;\n", o, numbers(matrix));
        }
      }
    return text;
  }

  const PlainGenerator& generator_;
  std::string text_;
  Json textures_ = Json::object();
  Json passes_ = Json::array();
};

}  // namespace

std::string export_glsl(const PlainGenerator& generator, const std::string& program) {
  const Shaders shaders(generator);
  Json levels = Json::array();
  for (const PlainLevel& level : generator.levels)
    levels.push_back({{"border", level.layers.size()}});
  const Json header{{"format", export_glsl_format},
                    {"program", comment_text(program)},
                    {"title", comment_text(generator.title)},
                    {"licence", comment_text(generator.licence)},
                    {"channels", generator.channels},
                    {"meaning", comment_text(channel_names(generator))},
                    {"levels", levels},
                    {"textures", shaders.textures()},
                    {"passes", shaders.passes()}};
  return "/* " + to_text(header) + explanation + common + shaders.text();
}

}  // namespace gramloom
