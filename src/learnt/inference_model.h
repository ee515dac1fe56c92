#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/cost.h"
#include "core/map_words.h"
#include "core/request.h"
#include "io/image_file.h"
#include "io/json_fields.h"
#include "io/safetensors.h"

namespace gramloom {

/// One of the numbers that a picture is inferred from, and its range in the pairs that were learnt.
struct PoseNumber {
  std::string name;
  double low = 0;
  double high = 0;

  friend bool operator==(const PoseNumber&, const PoseNumber&) = default;

  static constexpr auto fields() {
    using P = PoseNumber;
    return std::tuple{Field{"name", &P::name, "its column of the table"},
                      Field{"low", &P::low, "least that was learnt"},
                      Field{"high", &P::high, "most that was learnt"}};
  }
};

/// How far an inference is from pictures of pairs that neither its training nor the choice of its
/// best state has seen: the root of the mean square, relative to how far these are from the mean
/// of the pictures that it learnt. Beside it what simpler ways reach.
struct InferenceErrors {
  int learnt = 0;
  int chosen_by = 0;
  int tested = 0;
  double network = 0;
  double nearest = 0;
  double blend = 0;

  static constexpr auto fields() {
    using E = InferenceErrors;
    return std::tuple{
        Field{"learnt", &E::learnt, "pairs that were trained on"},
        Field{"chosen_by", &E::chosen_by, "pairs by which the best state was chosen"},
        Field{"tested", &E::tested, "pairs that the errors are of"},
        Field{"network", &E::network, "error of the network"},
        Field{"nearest", &E::nearest, "of the picture of the nearest pose that was learnt"},
        Field{"blend", &E::blend, "of the best blend of pictures of near poses"}};
  }
};

/// All that describes an inference but its numbers: the text "gramloom" in its file's metadata.
struct InferenceDescription {
  static constexpr int version = 1;
  std::string kind = "inference";
  std::vector<PoseNumber> pose;
  Size size{64, 64};
  int channels = 1;
  MapKind values = MapKind::scalar;
  PixelType pixel_type = PixelType::float32;
  Tile wraps = Tile::none;
  int pose_hidden = 128;
  std::vector<int> hidden{64, 48, 32, 16};
  std::string hash;
  Json recipe = Json::object();
  InferenceErrors errors;

  static constexpr auto fields() {
    using D = InferenceDescription;
    return std::tuple{
        Field{"kind", &D::kind, "of the model"},
        Field{"pose", &D::pose, "the numbers that it infers from, in their order"},
        Field{"size", &D::size, "of its pictures", "pixels", {1, 4096}},
        Field{"channels", &D::channels, "of its pictures", "", {1, 64}},
        Field{"values", &D::values, "what they mean"},
        Field{"pixel_type", &D::pixel_type, "how the files that it learnt store a value"},
        Field{"wraps", &D::wraps, "axes on which its pictures go on at the opposite edge"},
        Field{"pose_hidden", &D::pose_hidden, "values that the pose becomes", "", {4, 1024}},
        Field{"hidden", &D::hidden, "channels at each size, the smallest first", "", {4, 256}},
        Field{"hash", &D::hash, "of the table and pictures that it learnt"},
        Field{"recipe", &D::recipe, "how it was trained"},
        Field{"errors", &D::errors, "on pairs that training did not see"}};
  }
};

/// A trained inference: a small network that makes a picture of a few numbers, as in pose-dependent
/// displacement (compare Lahner, Cremers, Tung 2018, "DeepWrinkles").
///
///   p       the pose, each number brought from its trained range to −1 … 1
///   q       a(B₁ a(B₀ p)),   B linear with bias, a(x) = x / (1 + e⁻ˣ)
///   h₀      S q, linear: hidden[0] channels of the smallest size
///   h_{k+1} a(C_k h_k), a convolution of 3×3; made twice as large, linearly, but for the last one
///   picture mean + deviation · O h_n, O a convolution of 3×3; clamped to [low, high]
///
/// The sizes are the picture's, halved and rounded up once for each of `hidden` but the last; what
/// is too much after an enlargement is cut off at the right and below. Beyond its border a picture
/// goes on at the opposite one on axes that wrap, and repeats its last pixel on others.
///
/// `tensors`, by the names that LibTorch gives them:
///   pose.0.weight (pose_hidden, numbers)        pose.0.bias (pose_hidden)
///   pose.1.weight (pose_hidden, pose_hidden)    pose.1.bias (pose_hidden)
///   start.weight (hidden[0] · smallest height · width, pose_hidden)   start.bias
///   layers.K.weight (hidden[K + 1], hidden[K], 3, 3), the last (hidden[K], hidden[K], 3, 3)
///   layers.K.bias                               out.weight (channels, last hidden, 3, 3)  out.bias
///   pictures.mean (channels, height, width)
///   pictures.deviation, pictures.low, pictures.high (channels)
struct InferenceModel {
  InferenceDescription description;
  std::map<std::string, TensorData> tensors;

  const std::vector<float>& values(const std::string& tensor) const {
    return tensors.at(tensor).values;
  }
};

/// The size at each of `hidden`, the smallest first, the picture's last.
std::vector<Size> inference_sizes(const InferenceDescription& description);

/// Channels after the convolution number k.
int channels_after(const InferenceDescription& description, std::size_t k);

/// The shape of every tensor of such a model.
std::map<std::string, std::vector<std::int64_t>> tensor_shapes(
    const InferenceDescription& description);

/// Reads a .safetensors file. Throws Error in one line with the path for a file that is damaged, is
/// no inference or of a newer version, or whose tensors are missing, of another shape or not
/// finite.
InferenceModel read_inference(const std::filesystem::path& file);
/// Its description alone.
InferenceDescription read_inference_description(const std::filesystem::path& file);

/// Complete or not at all; `more`: further texts of its metadata. Throws Error.
void write_inference(const std::filesystem::path& file, const InferenceModel& model,
                     const std::map<std::string, std::string>& more = {});

/// Throws ConfigError for a pose of another number of values than the model's, one that is not
/// finite, or, unless `extrapolates`, one outside the range that is learnt, with names and range.
void check_pose(const std::vector<PoseNumber>& numbers, const std::vector<double>& pose,
                bool extrapolates);

/// The picture of a pose. Plain loops, without LibTorch or oneDNN: a picture of 64×64 takes some
/// milliseconds, and has the same bytes on every machine. The pose has the model's number of
/// values.
Image infer(const InferenceModel& model, const std::vector<double>& pose);

/// What that is expected to need.
Cost estimate_inference(const InferenceDescription& description);

}  // namespace gramloom
