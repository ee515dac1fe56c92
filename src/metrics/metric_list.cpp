#include "metrics/scores.h"

namespace gramloom {

namespace {

constexpr Metric list[]{
    {"stsim2", "likeness",
     "structural texture similarity: means, variances, neighbour correlations and correlations of "
     "magnitudes of the bands of a steerable pyramid",
     "0 to 1; 1 is equal", true, "Zujovic, Pappas, Neuhoff 2013",
     "colours off the exemplar's principal axis; shapes and layouts of equal band statistics; most "
     "textures lie above 0.8, so differences are small",
     1},
    {"portilla_simoncelli", "likeness",
     "distance of a texture's joint wavelet statistics: marginals, band energies, "
     "autocorrelations, "
     "magnitudes within and across scales, phases across scales",
     "from 0; 0 is equal", false, "Portilla & Simoncelli 2000",
     "colours off the principal axis; shapes larger than 3 samples of the coarsest of 4 scales"},
    {"random_features", "likeness",
     "distance of Gram matrices of a two-layer random network that no synthesis uses, at 4 scales",
     "from 0; 0 is equal, about 1 unlike", false,
     "Gatys, Ecker, Bethge 2015; Ustyuzhaninov et al. 2017",
     "layouts larger than about 60 pixels; methods that match other random networks come out well"},
    {"patch_wasserstein", "likeness",
     "sliced Wasserstein distance of 7x7 patches at 3 scales, in deviations", "from 0; 0 is equal",
     false, "Rabin, Peyre, Delon, Bernot 2011; Elnekave & Weiss 2022",
     "how patches are arranged: a jumble of true patches is nearly perfect; random phase of a fine "
     "grain comes out well; brightness and colours, which patches are compared without"},
    {"colour_wasserstein", "likeness", "sliced Wasserstein distance of colours, in deviations",
     "from 0; 0 is equal", false, "Rabin, Peyre, Delon, Bernot 2011",
     "any arrangement: shuffled pixels are perfect"},
    {"spectrum_db", "likeness",
     "difference of the radial power spectra, from 4 periods a side up, in dB",
     "from 0 dB; 0 is equal", false,
     "Galerne, Gousseau, Morel 2011 (the spectrum as a texture's model)",
     "shapes and directions: random phase is nearly perfect"},
    {"autocorrelation", "likeness",
     "difference of the self-correlations at shifts up to a quarter of the exemplar",
     "0 to 2; 0 is equal", false, "Julesz 1962 (second-order statistics)",
     "shapes: random phase is nearly perfect; textures without order differ little from noise"},
    {"copy_correlation", "copying",
     "strongest correlation with the exemplar over overlaps of a quarter of the smaller image",
     "0 to 1; low is original", false, "normalised cross-correlation",
     "regular textures (bricks, checks) correlate without copying; copies of small pieces, turned "
     "or "
     "mirrored ones are missed"},
    {"copied_share", "copying",
     "share of the area, flat parts aside, in 16x16 blocks that the exemplar has too, within 10 % "
     "of "
     "their variance (50 % where five patches in them agree on the place)",
     "0 to 1; low is original", false, "Barnes et al. 2009 (nearest patches)",
     "exact regular textures and smooth gradients are alike without copying; copies in pieces "
     "under "
     "16 pixels, turned, mirrored or recoloured are missed"},
    {"copy_coherence", "copying",
     "share of neighbouring patches whose nearest patches in the exemplar are neighbours too",
     "0 to 1; low is original", false, "Ashikhmin 2001 (coherence); He & Sun 2012 (search)",
     "the search itself favours coherence, so that originals come to some tenths: compare with the "
     "controls"},
    {"repetition", "repetition",
     "strongest self-correlation at shifts beyond an eighth of the exemplar's side, in excess of "
     "the "
     "exemplar's own",
     "0 to 1; 0 is no more regular than the exemplar", false, "normalised autocorrelation",
     "repeats of small pieces at irregular places; a result larger than the exemplar shows periods "
     "that the exemplar is too small to show"},
    {"seam_x", "seams",
     "step across the seam of the left and right edges over the strongest 5 % of lines inside",
     "from 0; up to 1 is invisible", false, "",
     "textures with strong straight lines along the seam hide it; shapes cut where colours agree",
     1},
    {"seam_y", "seams",
     "step across the seam of the upper and lower edges over the strongest 5 % of lines inside",
     "from 0; up to 1 is invisible", false, "", "as seam_x", 1},
    {"join", "seams",
     "of a filled picture: step across the outline of what was made over that of 95 % of places "
     "where the outline might lie",
     "from 0; up to 1 is invisible", false, "",
     "outlines that follow edges of the picture; a fill that is blurred or of the wrong kind", 1},
    {"diversity", "diversity",
     "1 less the mean strongest correlation at any shift of the results of two seeds",
     "0 to 1; 0 is the same picture", true, "",
     "noise and failures are diverse too; regular textures correlate whatever the seed", 1},
};

}  // namespace

std::span<const Metric> metrics() { return list; }

}  // namespace gramloom
