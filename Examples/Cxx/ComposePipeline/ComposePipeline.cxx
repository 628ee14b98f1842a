// SPDX-License-Identifier: GPL-3.0-or-later
/// Reader, octree, mesher, quality and writers, connected as any VTK filters.
///
///   ComposePipeline MODEL.wrl FOLDER
#include <vtkAtriaDualMesher.h>
#include <vtkAtriaMeshQuality.h>
#include <vtkAtriaOctreeSource.h>
#include <vtkAtriaOpenFOAMWriter.h>
#include <vtkAtriaVRMLReader.h>
#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: ComposePipeline MODEL.wrl FOLDER\n";
    return EXIT_FAILURE;
  }
  const std::string folder = argv[2];

  vtkNew<vtkAtriaVRMLReader> reader;
  reader->SetFileName(argv[1]);

  // The octree may be left out: the mesher then builds the same one. Shown here, it can be looked at or
  // changed.
  vtkNew<vtkAtriaOctreeSource> octree;
  octree->SetInputConnection(reader->GetOutputPort());
  octree->SetSizeMin(1.0); // meters
  octree->SetDomainMode(vtkAtriaOctreeSource::Site);
  octree->SetSiteName("Site");

  vtkNew<vtkAtriaDualMesher> mesher;
  mesher->SetInputConnection(0, reader->GetOutputPort());
  mesher->SetInputConnection(1, octree->GetOutputPort());

  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(0, mesher->GetOutputPort(0));
  quality->SetInputConnection(1, mesher->GetOutputPort(1));

  vtkNew<vtkXMLUnstructuredGridWriter> meshWriter;
  meshWriter->SetInputConnection(quality->GetOutputPort(0));
  meshWriter->SetFileName((folder + "/mesh.vtu").c_str());

  vtkNew<vtkXMLPartitionedDataSetCollectionWriter> patchWriter;
  patchWriter->SetInputConnection(mesher->GetOutputPort(1));
  patchWriter->SetFileName((folder + "/patches.vtpc").c_str());

  vtkNew<vtkAtriaOpenFOAMWriter> caseWriter;
  caseWriter->SetInputConnection(0, mesher->GetOutputPort(0));
  caseWriter->SetInputConnection(1, mesher->GetOutputPort(1));
  caseWriter->SetCaseDirectory((folder + "/case").c_str());

  const bool written = meshWriter->Write() && patchWriter->Write() && caseWriter->Write();
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0));
  std::cout << mesh->GetNumberOfCells() << " elements, " << quality->GetNumberOfInvalidCells() << " not valid\n";
  quality->GetSummary()->Dump(20);
  return written && mesh->GetNumberOfCells() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
