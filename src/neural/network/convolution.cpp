#include "neural/network/convolution.h"

#include <torch/csrc/autograd/custom_function.h>
#include <torch/custom_class.h>

#include <map>
#include <mutex>
#include <tuple>

#include "neural/network/plane_gradient.h"
#include "signal/onednn.h"

namespace gramloom::neural {

namespace {

using dnnl::memory;

dnnl::engine& engine() {
  static dnnl::engine cpu(dnnl::engine::kind::cpu, 0);
  return cpu;
}

memory::desc plain(memory::dims shape, memory::format_tag tag) {
  return {std::move(shape), memory::data_type::f32, tag};
}

memory::format_tag blocked() {
  return channel_block() == 16 ? memory::format_tag::nChw16c : memory::format_tag::nChw8c;
}

memory view(const memory::desc& desc, const at::Tensor& tensor) {
  return {desc, engine(), tensor.data_ptr()};
}

void execute(const dnnl::primitive& primitive, const std::unordered_map<int, memory>& arguments) {
  dnnl::stream stream(engine());
  primitive.execute(stream, arguments);
  stream.wait();
}

}  // namespace

struct ConvolutionState : torch::CustomClassHolder {
  // What a plan is made for. Zero padding is the convolution's own; other padding comes before it.
  struct Shape {
    std::int64_t height, width;  // of the input
    std::int64_t zeros_y, zeros_x;
    bool planes, relu;
    auto operator<=>(const Shape&) const = default;
  };

  struct Plan {
    dnnl::convolution_forward forward;
    dnnl::convolution_backward_data backward;
    memory::desc input, output;
    memory forward_weights, backward_weights;
    std::int64_t height, width;  // of the output
  };

  at::Tensor weights, bias;
  std::int64_t dilation;
  std::map<Shape, Plan> plans;
  std::vector<memory> weights_as;  // the weights in each layout that a plan asked for

  std::int64_t outputs() const { return weights.size(0); }
  std::int64_t inputs() const { return weights.size(1); }
  std::int64_t span() const { return (weights.size(2) - 1) * dilation; }

  memory arranged(const memory::desc& desc) {
    for (const auto& known : weights_as)
      if (known.get_desc() == desc) return known;
    const auto own =
        plain({outputs(), inputs(), weights.size(2), weights.size(3)}, memory::format_tag::oihw);
    memory source = view(own, weights), target(desc, engine());
    execute(dnnl::reorder(source, target), {{DNNL_ARG_FROM, source}, {DNNL_ARG_TO, target}});
    weights_as.push_back(target);
    return target;
  }

  Plan make_plan(const Shape& shape, dnnl::algorithm algorithm) {
    const memory::dims stride{1, 1}, dilate{dilation - 1, dilation - 1};
    const memory::dims zeros{shape.zeros_y, shape.zeros_x};
    Plan plan;
    plan.height = shape.height + 2 * shape.zeros_y - span();
    plan.width = shape.width + 2 * shape.zeros_x - span();
    const memory::dims in{1, inputs(), shape.height, shape.width};
    plan.input = plain(in, shape.planes ? memory::format_tag::nchw : blocked());
    plan.output = plain({1, outputs(), plan.height, plan.width}, blocked());
    const auto any_weights =
        plain({outputs(), inputs(), weights.size(2), weights.size(3)}, memory::format_tag::any);
    const auto any_bias =
        bias.defined() ? plain({outputs()}, memory::format_tag::x) : memory::desc();

    dnnl::primitive_attr after;
    if (shape.relu) {
      dnnl::post_ops operations;
      append_relu(operations);
      after.set_post_ops(operations);
    }
    ConvolutionShape described{plan.input, any_weights, any_bias, plan.output,
                               stride,     dilate,      zeros};
    const auto forward = describe_forward(engine(), algorithm, described, after);
    plan.forward = dnnl::convolution_forward(forward);
    plan.forward_weights = arranged(forward.weights_desc());
    if (shape.planes) return plan;  // whose gradient is plane_gradient()

    described.bias = memory::desc();
    const auto hint = describe_forward(engine(), algorithm, described, {});
    const auto backward = describe_backward(engine(), algorithm, described, hint);
    plan.backward = dnnl::convolution_backward_data(backward);
    plan.backward_weights = arranged(backward.weights_desc());
    return plan;
  }

  const Plan& plan(const Shape& shape) {
    if (const auto found = plans.find(shape); found != plans.end()) return found->second;
    try {
      // Winograd reads and writes blocks only; few-channel pictures take the direct way in.
      return plans[shape] = make_plan(shape, shape.planes ? dnnl::algorithm::convolution_direct
                                                          : dnnl::algorithm::convolution_winograd);
    } catch (const dnnl::error&) {  // not for this kernel or processor
      return plans[shape] = make_plan(shape, dnnl::algorithm::convolution_direct);
    }
  }
};

namespace {

using StatePtr = c10::intrusive_ptr<ConvolutionState>;

struct ConvolutionFunction : torch::autograd::Function<ConvolutionFunction> {
  static at::Tensor forward(torch::autograd::AutogradContext* context, const at::Tensor& input,
                            StatePtr state, std::int64_t zeros_y, std::int64_t zeros_x, bool relu) {
    const bool planes = input.dim() == 3;
    const ConvolutionState::Shape shape{input.size(1), input.size(2), zeros_y,
                                        zeros_x,       planes,        relu};
    const ConvolutionState::Plan& plan = state->plan(shape);
    const std::int64_t block = channel_block();
    at::Tensor output = at::empty(
        {(state->outputs() + block - 1) / block, plan.height, plan.width, block}, input.options());
    std::unordered_map<int, memory> arguments{{DNNL_ARG_SRC, view(plan.input, input)},
                                              {DNNL_ARG_WEIGHTS, plan.forward_weights},
                                              {DNNL_ARG_DST, view(plan.output, output)}};
    if (state->bias.defined())
      arguments[DNNL_ARG_BIAS] =
          view(plain({state->outputs()}, memory::format_tag::x), state->bias);
    execute(plan.forward, arguments);
    context->saved_data["state"] = c10::IValue::make_capsule(std::move(state));
    context->saved_data["shape"] =
        std::vector<std::int64_t>{shape.height, shape.width, zeros_y, zeros_x, planes, relu};
    if (relu) context->save_for_backward({output});
    return output;
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const auto state = c10::static_intrusive_pointer_cast<ConvolutionState>(
        context->saved_data["state"].toCapsule());
    const auto s = context->saved_data["shape"].toIntVector();
    const ConvolutionState::Shape shape{s[0], s[1], s[2], s[3], s[4] != 0, s[5] != 0};
    const ConvolutionState::Plan& plan = state->plan(shape);
    at::Tensor upstream = gradients[0].contiguous();
    if (shape.relu)
      upstream = at::threshold_backward(upstream, context->get_saved_variables()[0], 0);
    if (shape.planes)
      return {plane_gradient(upstream, state->weights, state->dilation), {}, {}, {}, {}};
    const std::int64_t block = channel_block();
    at::Tensor result =
        at::empty({(state->inputs() + block - 1) / block, shape.height, shape.width, block},
                  upstream.options());
    execute(plan.backward, {{DNNL_ARG_DIFF_DST, view(plan.output, upstream)},
                            {DNNL_ARG_WEIGHTS, plan.backward_weights},
                            {DNNL_ARG_DIFF_SRC, view(plan.input, result)}});
    return {result, {}, {}, {}, {}};
  }
};

at::Tensor convolve_in_double(const ConvolutionState& state, const at::Tensor& planes, bool relu) {
  const std::vector<std::int64_t> stride{1, 1}, zeros{0, 0},
      dilation{state.dilation, state.dilation};
  const at::Tensor result = at::conv2d(planes.unsqueeze(0), state.weights, state.bias, stride,
                                       at::IntArrayRef(zeros), dilation)
                                .squeeze(0);
  return relu ? at::relu(result) : result;
}

}  // namespace

Convolution::Convolution(at::Tensor weights, at::Tensor bias, std::int64_t dilation)
    : state_(c10::make_intrusive<ConvolutionState>()) {
  state_->weights = weights.contiguous();
  state_->bias = bias.defined() ? bias.contiguous() : bias;
  state_->dilation = dilation;
}
Convolution::~Convolution() = default;
Convolution::Convolution(Convolution&&) noexcept = default;
Convolution& Convolution::operator=(Convolution&&) noexcept = default;

std::int64_t Convolution::radius() const { return state_->span() / 2; }

FeatureMaps Convolution::operator()(const FeatureMaps& maps, Edges edges, bool relu) const {
  if (maps.data.scalar_type() != at::kFloat) return (*this)(to_planes(maps), edges, relu);
  const std::int64_t zeros_y = edges.y == Padding::zero ? radius() : 0;
  const std::int64_t zeros_x = edges.x == Padding::zero ? radius() : 0;
  const Edges before{zeros_x ? Padding::valid : edges.x, zeros_y ? Padding::valid : edges.y};
  const at::Tensor padded = pad(maps, radius(), before).data.contiguous();
  return {ConvolutionFunction::apply(padded, state_, zeros_y, zeros_x, relu), state_->outputs()};
}

FeatureMaps Convolution::operator()(const at::Tensor& planes, Edges edges, bool relu) const {
  const at::Tensor padded = pad_planes(planes, radius(), edges).contiguous();
  if (planes.scalar_type() != at::kFloat) return to_maps(convolve_in_double(*state_, padded, relu));
  return {ConvolutionFunction::apply(padded, state_, 0, 0, relu), state_->outputs()};
}

}  // namespace gramloom::neural
