// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads OpenFOAM meshes by VTK.
#pragma once

#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkSmartPointer.h>

#include <filesystem>

namespace atria::testing {

/// Readers before VTK 9.5 else make tetrahedra and pyramids of polyhedra; later ones cannot.
template <typename Reader> void keepPolyhedra(Reader& reader)
{
  if constexpr (requires { reader.DecomposePolyhedraOff(); })
  {
    reader.DecomposePolyhedraOff();
  }
}

/// A reader, updated, of the case that a .foam file stands in, with all of its patches. Labels have 32 bits.
inline vtkSmartPointer<vtkOpenFOAMReader> readFoam(const std::filesystem::path& file)
{
  vtkNew<vtkOpenFOAMReader> reader;
  reader->SetFileName(file.c_str());
  reader->SetUse64BitLabels(false);
  keepPolyhedra(*reader);
  reader->UpdateInformation();
  reader->EnableAllPatchArrays();
  reader->Update();
  return reader;
}

} // namespace atria::testing
