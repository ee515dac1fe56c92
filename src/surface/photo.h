#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "core/image.h"

namespace gramloom {

/// What becomes of a photograph's colour cast: it stays; it is made the same all over the picture;
/// or the mean colour is made grey, too, for a material that is.
enum class ColourCast { keep, even, grey };
template <>
inline constexpr auto enum_names<ColourCast> = std::to_array<std::string_view>({"keep", "even",
                                                                                "grey"});

/// How a photograph of a flat piece of material becomes that material's maps: the options of
/// `gramloom maps --from-photo`.
struct PhotoParams {
  static constexpr std::string_view name = "photo";
  static constexpr std::string_view summary = "a photograph's material: colour, height, roughness";

  std::vector<double> corners;
  std::vector<int> photo_size;
  double light_amount = 1;
  double light_scale = 0.25;
  ColourCast cast = ColourCast::even;
  double height_detail = 0.75;
  double height_scale = 0.35;
  bool bright_is_deep = false;
  double roughness = 0.8;
  double roughness_contrast = 0.3;

  static constexpr auto fields() {
    using P = PhotoParams;
    return std::tuple{
        Field{"corners",
              &P::corners,
              "of a rectangle in the photo, to be set right: x and y of its top left, top right, "
              "bottom right and bottom left",
              "pixels",
              {-1e6, 1e6}},
        Field{"photo_size",
              &P::photo_size,
              "width and height of the rectangle set right; that of its sides if not set",
              "pixels",
              {1, 32768}},
        Field{"light_amount",
              &P::light_amount,
              "how much of the uneven light is taken out",
              "",
              {0, 1}},
        Field{"light_scale",
              &P::light_scale,
              "from which size on a change of brightness is the light's and not the material's",
              "shorter sides",
              {0.02, 2}},
        Field{"cast", &P::cast,
              "the light's colour: keep it, make it even, or make the picture's mean grey"},
        Field{
            "height_detail",
            &P::height_detail,
            "height of each octave of detail over that of the next coarser one, for equal contrast",
            "",
            {0, 2}},
        Field{"height_scale",
              &P::height_scale,
              "the largest forms that heights are guessed of",
              "shorter sides",
              {0.002, 1}},
        Field{"bright_is_deep", &P::bright_is_deep, "whether what is dark stands higher"},
        Field{"roughness", &P::roughness, "mean of the roughness map", "", {0, 1}},
        Field{"roughness_contrast",
              &P::roughness_contrast,
              "how much rougher the deepest place is than the highest",
              "",
              {0, 1}},
    };
  }
};

/// The quadrangle of these four corners (PhotoParams::corners; pixel (0, 0) has its middle at 0, 0)
/// as a rectangle, seen from the front: the homography through four points (Heckbert 1989,
/// "Fundamentals of texture mapping and image warping", section 2.2.3; OpenCV). Without a size,
/// each side is as long as the mean of the two that it comes from. Throws ConfigError unless there
/// are four corners of a convex quadrangle, clockwise; for a size of other than two numbers.
Image set_right(const Image& photo, const std::vector<double>& corners,
                const std::vector<int>& size);

/// The photograph less its shading: each colour divided by what varies over the whole picture. The
/// logarithm of the brightness is a quadratic polynomial of the place (light that falls off, a lens
/// that darkens corners), fitted by least squares, and what is left of it after a Gaussian blur of
/// `scale` times the shorter side (as in homomorphic filtering: Oppenheim, Schafer, Stockham 1968);
/// its mean stays. Values are taken as encoded: a power of the light, as which a factor stays one.
/// An alpha channel stays as it is.
Image without_shading(const Image& photo, double scale, double amount, ColourCast cast);

/// A guess of the height of each point from its brightness, 0 to 1, one channel: that what is
/// bright stands higher, at each scale by itself. Bands between Gaussian blurs an octave apart,
/// from `scale` times the shorter side down to the pixel, each weighed `detail` times the one
/// before; half a percent of the values at each end are cut off. It is a guess: white paint on a
/// black wall comes out as a step. `wraps`: the axes on which the picture tiles, and then its
/// height does.
Image height_guess(const Image& colour, double scale, double detail, bool bright_is_deep,
                   Tile wraps = Tile::none);

/// A guess of the roughness of each point from its height: `mean` on the mean height, rougher by
/// `contrast` in the deepest place than on the highest. What lies deep is joint, dust and shade,
/// and what stands out is worn smooth. Of a brick wall, a stone wall and pebbles whose roughness
/// was scanned this correlates with 0.92, 0.69 and 0.92; fine contrast, another guess, with −0.25
/// to 0.54.
Image roughness_guess(const Image& height, double mean, double contrast);

/// All of that: "colour", "height" and "roughness". Throws ConfigError for parameters out of range,
/// Error for a photograph of other than 1, 3 or 4 channels.
std::map<std::string, Image> material_from_photo(const Image& photo, const PhotoParams& params);

}  // namespace gramloom
