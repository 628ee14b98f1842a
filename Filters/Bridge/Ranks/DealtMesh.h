// SPDX-License-Identifier: GPL-3.0-or-later
/// Distributes a mesh of the first rank to all ranks.
#pragma once

#include "Ranks/Ranks.h"
#include "Support/Types.h"

#include <vector>

namespace atria {

/// Returns the largest number of ghost levels that any rank requests, at least one. All ranks must call it.
int ghostLevelsAsked(vtkInformationVector* outputs, vtkMultiProcessController& controller);

/// Distributes the outputs of an algorithm that ran on the first rank; those of the others are empty before. `rankOf`,
/// on the first rank, has the rank of each cell, if that is known. The first rank makes one piece after the other, so
/// that it holds the whole and one piece at most. Returns the result of RequestData. If the first rank cannot make a
/// piece, it reports an error; all ranks then return 0 and have empty outputs.
int dealMesh(vtkAlgorithm& algorithm, vtkInformationVector* outputs, const DealtOutputs& dealt,
             std::vector<Index> rankOf, vtkMultiProcessController& controller);

} // namespace atria
