// SPDX-License-Identifier: GPL-3.0-or-later
/// What a mesh holds, by whichever reader it was read.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/SampleMesh.h"

#include <map>
#include <string>

class vtkDataObject;
class vtkMultiBlockDataSet;
class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace atria::testing {

struct PatchFacts
{
  std::size_t faces = 0;
  double area = 0.0;
};

struct MeshFacts
{
  std::size_t cells = 0;
  double volume = 0.0; ///< negative where all cells are inside out
  std::map<std::string, PatchFacts> patches;
};

MeshFacts factsOf(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches);

/// The blocks by name: volume meshes together, polydata as patches.
MeshFacts factsOf(vtkMultiBlockDataSet* data);

/// An SU2 file as its elements say. Fails the test where its markers are not the boundary of its elements, each face
/// once.
MeshFacts factsOfSU2(const std::string& file);

/// Fails the test where they are not the same, but for rounding. `faces`: whether patches have as many faces, too.
void expectSameFacts(const MeshFacts& found, const MeshFacts& expected, double tolerance, bool faces = true);

} // namespace atria::testing
