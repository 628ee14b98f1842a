// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/ModelStages.h"

namespace atria {

/// A model that was made with `features` with the openings in it, if there are any, as surfaces
/// `<Surface>_opening_<n>` that are face zones. See findOpenings. Throws Error for a pattern that matches no surface.
SurfaceModel withOpenings(SurfaceModel model, const PlacedModel& placed, FeatureOptions features,
                          const ModelOptions& options, const RunContext& context);

} // namespace atria
