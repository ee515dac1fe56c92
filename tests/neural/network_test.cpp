#include "neural/network/network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/safetensors.h"
#include "io/text_file.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

using testing::HasSubstr;

template <class F>
std::string message(F&& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

constexpr Edges wrap{Padding::circular, Padding::circular};

TEST(Models, EveryDescriptionThatWeShipIsValid) {
  const auto files = known_networks();
  EXPECT_GE(files.size(), 3u);
  for (const auto& file : files) {
    const NetworkDescription network = read_network(file);
    EXPECT_EQ(network.name, file.stem());
    EXPECT_NE(network.summary, "");
  }
}

TEST(Models, Vgg19HasThePublishedParameters) {
  // Simonyan, Zisserman 2015, table 1, configuration E: weights and biases of the convolutions.
  const std::vector<std::int64_t> published{1792,    36928,   73856,   147584,  295168,  590080,
                                            590080,  590080,  1180160, 2359808, 2359808, 2359808,
                                            2359808, 2359808, 2359808, 2359808};
  std::vector<std::int64_t> ours;
  for (const auto& shape : filter_shapes(read_network(find_network("vgg19")), 3))
    ours.push_back(shape.parameters());
  EXPECT_EQ(ours, published);
}

TEST(Models, Vgg19NamesItsLayersAsThePaperDoes) {
  const NetworkDescription vgg = read_network(find_network("vgg19"));
  EXPECT_EQ(find_layer(vgg, "conv1_1"), 0u);
  EXPECT_EQ(find_layer(vgg, "relu5_4"), 35u);
  EXPECT_EQ(find_layer(vgg, "pool5"), 36u);
  EXPECT_THAT(message([&] { find_layer(vgg, "pol4"); }), HasSubstr("did you mean 'pool4'?"));
  EXPECT_THAT(message([] { find_network("vgg_smal"); }), HasSubstr("unknown network 'vgg_smal'"));
}

class BadDescription : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(BadDescription, SaysWhereAndWhat) {
  const auto [text, expected] = GetParam();
  const auto file = std::filesystem::path(testing::TempDir()) /
                    fmt::format("bad_network_{}.toml", std::hash<std::string>()(text));
  write_text(file, text);
  EXPECT_THAT(message([&] { read_network(file); }), HasSubstr(file.string() + expected));
  std::filesystem::remove(file);
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, BadDescription,
    testing::Values(
        std::pair{"matched = [\"a\"]\n", ":1:1: key 'name' is missing"},
        std::pair{"name = \"n\"\nmatched = [\"a\"]\n", ":1:1: a network needs [[layer]] tables"},
        std::pair{"name = \"n\"\nmatched = [\"a\"]\n[[layer]]\nname = \"a\"\ntype = \"conv\"\n",
                  ":5:1: unknown type 'conv'"},
        std::pair{"name = \"n\"\nmatched = [\"a\"]\n[[layer]]\nname = \"a\"\ntype = "
                  "\"convolution\"\nkernel = 4\n",
                  ":6:1: 'kernel' = 4: a filter's side must be odd"},
        std::pair{"name = \"n\"\nmatched = [\"a\"]\n[[layer]]\nname = \"a\"\ntype = "
                  "\"relu\"\nchanels = 4\n",
                  ":6:1: unknown key 'chanels'"},
        std::pair{"name = \"n\"\nmatched = [\"b\"]\n[[layer]]\nname = \"a\"\ntype = \"relu\"\n",
                  ":2:1: unknown layer 'b'"},
        std::pair{"name = \"n\"\nmatched = [\"a\"]\n[[layer]]\nname = \"a\"\ntype = "
                  "\"bank\"\nkernels = [3, 5]\nblurs = [1]\n",
                  ":7:1: 'blurs' has 1 values, 'kernels' has 2"},
        std::pair{"name = 3\n", ":1:1: 'name' is a whole number"}));

TEST(Network, FusedReluIsTheSameAsItsOwnLayer) {
  const NetworkDescription vgg = read_network(find_network("vgg_small"));
  const auto shapes = filter_shapes(vgg, 3);
  const Network network(vgg, shapes, random_filters(shapes, RandomWeights::he_normal, 1),
                        Pooling::as_described);
  const at::Tensor picture = numbers({3, 32, 40}, 1);
  // Asking for conv1_2 keeps its values before ReLU; asking for relu1_2 alone fuses the two.
  const auto apart =
      network(picture, wrap, {find_layer(vgg, "conv1_2"), find_layer(vgg, "relu1_2")});
  const auto fused = network(picture, wrap, {find_layer(vgg, "relu1_2")});
  EXPECT_LT(apart[0][0].data.min().item<float>(), 0);
  EXPECT_TRUE(at::equal(at::relu(apart[0][0].data), apart[1][0].data));
  EXPECT_TRUE(at::equal(apart[1][0].data, fused[0][0].data));
}

TEST(Network, CircularPaddingCommutesWithShifts) {
  const NetworkDescription bank = read_network(find_network("multiscale"));
  const auto shapes = filter_shapes(bank, 3);
  const Network network(bank, shapes, random_filters(shapes, RandomWeights::he_normal, 1),
                        Pooling::as_described);
  const at::Tensor picture = numbers({3, 24, 32}, 2);
  const at::Tensor shifted = at::roll(picture, {5, -9}, {1, 2});
  const at::Tensor a = to_planes(network(picture, wrap, {1})[0][0]);
  const at::Tensor b = to_planes(network(shifted, wrap, {1})[0][0]);
  EXPECT_LT(relative_difference(at::roll(a, {5, -9}, {1, 2}), b), 1e-5);
}

TEST(Network, APictureTooSmallIsNamed) {
  const NetworkDescription vgg = read_network(find_network("vgg19"));
  const auto shapes = filter_shapes(vgg, 3);
  const Network network(vgg, shapes, random_filters(shapes, RandomWeights::he_normal, 1),
                        Pooling::as_described);
  EXPECT_THAT(message([&] {
                network(numbers({3, 9, 9}, 1), wrap, {find_layer(vgg, "pool4")});
              }),
              HasSubstr("layer 'pool4' of network 'vgg19' would be empty: a picture of 9×9"));
  EXPECT_THAT(message([&] {
                network(numbers({3, 9, 9}, 1), {Padding::valid, Padding::valid},
                        {find_layer(vgg, "pool4")});
              }),
              HasSubstr("would be empty"));
}

TEST(Network, RescaledFiltersHaveMeanActivationOne) {
  const NetworkDescription vgg = read_network(find_network("vgg_small"));
  const auto shapes = filter_shapes(vgg, 3);
  const at::Tensor picture = numbers({3, 64, 64}, 3);
  const Network network =
      Network::rescaled(vgg, shapes, random_filters(shapes, RandomWeights::he_normal, 1),
                        Pooling::as_described, picture, wrap);
  for (const char* layer : {"relu1_1", "relu2_2", "relu4_2"}) {
    const at::Tensor means =
        to_planes(network(picture, wrap, {find_layer(vgg, layer)})[0][0]).mean({1, 2});
    const at::Tensor alive = means.masked_select(means > 0);
    EXPECT_GT(alive.numel(), means.numel() / 2);
    EXPECT_LT((alive - 1).abs().max().item<double>(), 1e-3) << layer;
  }
}

TEST(RandomFilters, HaveTheirVarianceAndDependOnTheSeed) {
  const std::vector<FilterShape> shapes{{0, 256, 16, 3, 1, 0}};
  const auto a = random_filters(shapes, RandomWeights::he_normal, 1)[0].weights;
  EXPECT_NEAR(a.var().item<double>(), 2.0 / (16 * 9), 2.0 / (16 * 9) * 0.03);
  EXPECT_TRUE(at::equal(a, random_filters(shapes, RandomWeights::he_normal, 1)[0].weights));
  EXPECT_FALSE(at::equal(a, random_filters(shapes, RandomWeights::he_normal, 2)[0].weights));
}

TEST(RandomFilters, OrthogonalOnesAre) {
  const std::vector<FilterShape> shapes{{0, 40, 3, 3, 1, 0}};  // 40 filters of 27 values
  const auto filters =
      random_filters(shapes, RandomWeights::orthogonal, 1)[0].weights.reshape({40, 27});
  const at::Tensor first = filters.narrow(0, 0, 27);
  EXPECT_LT(relative_difference(at::mm(first, first.t()), at::eye(27) * 2), 1e-5);
}

class WeightsFile : public testing::Test {
 protected:
  void SetUp() override {
    network_.name = "two";
    network_.layers = {{"conv1", ConvolutionLayer{4, 3, 1}},
                       {"relu1", ReluLayer{}},
                       {"conv2", ConvolutionLayer{5, 3, 1}}};
    file_ = std::filesystem::path(testing::TempDir()) /
            fmt::format("weights_{}.safetensors", testing::UnitTest::GetInstance()->random_seed() +
                                                      reinterpret_cast<std::uintptr_t>(this));
    add("features.0.weight", {4, 3, 3, 3});
    add("features.0.bias", {4});
    add("features.2.weight", {5, 4, 3, 3});
    add("features.2.bias", {5});
  }
  void TearDown() override { std::filesystem::remove(file_); }
  void add(const std::string& name, std::vector<std::int64_t> shape) {
    std::size_t count = 1;
    for (const auto n : shape) count *= static_cast<std::size_t>(n);
    TensorData data{std::move(shape), std::vector<float>(count)};
    for (std::size_t i = 0; i < count; ++i) data.values[i] = static_cast<float>(i) * 0.01f;
    tensors_[name] = data;
  }
  std::vector<FilterWeights> load() {
    write_tensors(file_, tensors_);
    return load_filters(network_, filter_shapes(network_, 3), file_);
  }

  NetworkDescription network_;
  std::filesystem::path file_;
  std::map<std::string, TensorData> tensors_;
};

TEST_F(WeightsFile, IsReadByTorchvisionsNames) {
  add("classifier.0.weight", {2, 2});  // not ours to look at
  const auto weights = load();
  ASSERT_EQ(weights.size(), 2u);
  EXPECT_EQ(weights[1].weights.sizes(), at::IntArrayRef({5, 4, 3, 3}));
  EXPECT_FLOAT_EQ(weights[1].bias[3].item<float>(), 0.03f);
}

TEST_F(WeightsFile, AMissingTensorIsNamed) {
  tensors_.erase("features.2.bias");
  EXPECT_THAT(message([&] { load(); }), HasSubstr(": no tensor 'features.2.bias'"));
}

TEST_F(WeightsFile, AWrongShapeIsNamed) {
  add("features.2.weight", {5, 3, 3, 3});
  EXPECT_THAT(message([&] { load(); }),
              HasSubstr("tensor 'features.2.weight' has shape [5, 3, 3, 3], the network needs "
                        "[5, 4, 3, 3]"));
}

TEST_F(WeightsFile, SeveralFilterBanksInALayerAreRefused) {
  for (const LayerKind& kind :
       {LayerKind(BankLayer{4, {3, 3}, {1, 2}, {0, 0}}), LayerKind(PyramidLayer{4, 3, 2})}) {
    network_.layers = {{"first", kind}, {"relu1", ReluLayer{}}};
    EXPECT_THAT(message([&] { load(); }), HasSubstr("which only random weights can fill"));
  }
}

TEST_F(WeightsFile, NotANumberIsNamed) {
  tensors_["features.0.bias"].values[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(message([&] { load(); }), HasSubstr("tensor 'features.0.bias' holds a value"));
}

}  // namespace
}  // namespace gramloom::neural
