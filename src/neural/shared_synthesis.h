#pragma once

#include "neural/gloo_group.h"
#include "neural/synthesis.h"

namespace gramloom {

// One texture by several processes. Each has some of the rows of all large pictures, and of their
// gradients: sums over positions (Gram matrices, counts of patches' values) are those of all
// processes, and rows at the seams are looked at by both sides. What is small each has whole: the
// exemplar, the network, and the pictures of coarse levels (neural/settings.h: is_shared). The
// texture is that of one process but for rounding.

/// Waits for the others and joins them. Throws neural::GroupLost.
std::shared_ptr<neural::Group> join_group(const neural::GroupPlace& place);

/// The own rows of the texture: rows [height·rank/size, height·(rank+1)/size). All processes of the
/// group ask for the same; when one is told to stop, all are. There are no checkpoints. Throws
/// neural::GroupLost when another one is gone, and what synthesise() throws.
Texture synthesise_rows(const NeuralParams& params, const Request& request, const Control& control,
                        const neural::Group& group);

namespace neural {
/// Throws ConfigError for what so many processes cannot honour together: more than one exemplar as
/// a whole; terms that look at all of a picture at once; a layout by flow on a level that is
/// shared; match_histogram; a texture too small to be shared.
void check_shared(const NeuralParams& params, const RequestSize& request, int processes);
}  // namespace neural

/// Peak memory of one of these processes, and its time.
Cost estimate_share(const NeuralParams& params, const RequestSize& request, int processes);

}  // namespace gramloom
