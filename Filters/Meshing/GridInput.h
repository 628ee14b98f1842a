// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts the properties and input data of filters of a model's grid to structures of the core.
#pragma once

#include "Mesher/ModelStages.h"
#include "Support/RankExchange.h"

#include <functional>
#include <span>

class vtkAtriaGridAlgorithm;
class vtkDataObject;
class vtkMultiProcessController;

namespace atria {

/// Returns the filter's properties and the surfaces that the data mark as ground. Sizes of 0 must still be completed.
/// Throws Error for invalid rules.
ModelOptions modelOptionsOf(vtkAtriaGridAlgorithm& filter, vtkDataObject* surfaces);

/// The same, with sizes from the model in place of sizes of 0; see completeSizes in Mesher/SuggestedSizes.h.
ModelOptions modelOptionsOf(vtkAtriaGridAlgorithm& filter, vtkDataObject* surfaces, const TriangleSurface& surface);

/// Runs `work` on the updated data of input port 0, or null without a connection, on the rank that has all of it; see
/// Ranks.h. Exceptions of `work` become errors of the filter. Returns true if the work was done. All ranks get `values`
/// as `work` set them.
bool onCurrentInput(vtkAtriaGridAlgorithm& filter, std::span<double> values,
                    const std::function<void(vtkDataObject*)>& work);

/// Reads surfaces. `data` may be null: a domain without surfaces. Adds warnings for the user.
TriangleSurface readSurfaces(vtkDataObject* data, std::vector<std::string>& warnings);

struct SharedSurfaces
{
  TriangleSurface surface;
  /// Names of surfaces that are ground.
  std::vector<std::string> grounds;
  /// Offset that a reader subtracted from its points, model units.
  Vec3 offset;
  /// Warnings for the user, on the first rank.
  std::vector<std::string> warnings;
};

/// Returns the surfaces of all ranks, on all of them. All ranks call it at the same time, right after an exchange.
/// Throws as readSurfaces().
SharedSurfaces readSurfacesOnRanks(vtkDataObject* own, vtkMultiProcessController& controller, RankExchange& exchange);

/// Returns the offset that a reader subtracted from the model's points, so that writers can add it again; zero if the
/// data have none.
Vec3 modelOffsetOf(vtkDataObject* surfaces);

void addTo(std::vector<std::string>& warnings, const std::vector<std::string>& more);

/// Adds the field array SizingWarning, with one text or none, and warns.
void addSizingWarning(const std::string& warning, vtkAtriaGridAlgorithm& filter, vtkDataObject* out);

/// Adds the field array InputWarning, and warns of each.
void addInputWarnings(const std::vector<std::string>& warnings, vtkAtriaGridAlgorithm& filter, vtkDataObject* out);

/// Adds the field array InputNote.
void addInputNotes(const std::vector<std::string>& notes, vtkDataObject* out);

} // namespace atria
