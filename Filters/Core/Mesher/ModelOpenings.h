// SPDX-License-Identifier: GPL-3.0-or-later
/// Adds the openings that a rule finds in walls to a model.
#pragma once

#include "Mesher/ModelStages.h"

namespace atria {

/// Returns a model that was made with `features`, with the openings in it as surfaces `<Surface>_opening_<n>` that are
/// face zones. Without openings, returns the model as it is. See findOpenings. Throws Error if a pattern matches no
/// surface.
SurfaceModel withOpenings(SurfaceModel model, const PlacedModel& placed, FeatureOptions features,
                          const ModelOptions& options, const RunContext& context);

} // namespace atria
