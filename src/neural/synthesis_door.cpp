// Where the rest of the program enters the module that needs LibTorch.
#include "core/abilities.h"
#include "core/modules.h"
#include "neural/blas_speed.h"
#include "neural/directed_settings.h"
#include "neural/module.h"
#include "neural/settings.h"
#include "neural/shared_synthesis.h"
#include "neural/synthesis.h"

namespace gramloom {

Texture synthesise(const NeuralParams& params, const Request& request, const Control& control) {
  neural::check_settings(params);
  check_request<NeuralParams>(request);
  neural::directed_settings(params, size_of(request), neural::has_one_mix(request.target));
  return open_module<NeuralModule>().synthesise(params, request, control, neural::one_process());
}

Texture synthesise_rows(const NeuralParams& params, const Request& request, const Control& control,
                        const neural::Group& group) {
  neural::check_settings(params);
  check_request<NeuralParams>(request);
  neural::check_shared(params, size_of(request), group.size());
  return open_module<NeuralModule>().synthesise(params, request, control, group);
}

std::shared_ptr<neural::Group> join_group(const neural::GroupPlace& place) {
  return open_module<NeuralModule>().join_group(place);
}

double blas_gigaflops() { return open_module<NeuralModule>().blas_gigaflops(); }

double operations_per_second() { return open_module<NeuralModule>().operations_per_second(); }

}  // namespace gramloom
