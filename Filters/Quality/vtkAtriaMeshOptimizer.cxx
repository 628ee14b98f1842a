// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaMeshOptimizer.h"

#include "AddArray.h"
#include "AlgorithmProgress.h"
#include "Optimize/AnyMesh/MeshOptimizer.h"
#include "PropertyRange.h"
#include "Ranks/Ranks.h"
#include "VtkArrays.h"
#include "VtkFaceMesh.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

vtkStandardNewMacro(vtkAtriaMeshOptimizer);

namespace {

/// Returns the patch of each boundary face; all faces without one have the same number. Empty without patches.
std::vector<atria::Index> patchOfFaces(const atria::VtkFaceMesh& source)
{
  const auto& patches = source.patches.patches;
  if (patches.empty())
  {
    return {};
  }
  const std::size_t first = source.mesh.internalFaceCount();
  std::vector<atria::Index> out(source.mesh.faceCount() - first, static_cast<atria::Index>(patches.size()));
  for (std::size_t p = 0; p < patches.size(); ++p)
  {
    for (std::size_t i = 0; i < patches[p].faceCount; ++i)
    {
      out[source.patchFaces[patches[p].firstFace + i] - first] = static_cast<atria::Index>(p);
    }
  }
  return out;
}

/// Returns the points of faces in face zones, and of faces between different cell zones.
std::vector<atria::Index> pointsOfZones(const atria::VtkFaceMesh& source, vtkUnstructuredGrid* volume)
{
  const atria::FaceMesh& mesh = source.mesh;
  std::vector<atria::Index> faces = source.zoneFaces;
  vtkDataArray* cellZones = volume->GetCellData()->GetArray("CellZoneId");
  for (atria::Index face = 0; cellZones && face < mesh.internalFaceCount(); ++face)
  {
    if (cellZones->GetComponent(mesh.owner[face], 0) != cellZones->GetComponent(mesh.neighbor[face], 0))
    {
      faces.push_back(face);
    }
  }
  std::vector<atria::Index> points;
  for (const atria::Index face : faces)
  {
    points.insert(points.end(), mesh.face(face).begin(), mesh.face(face).end());
  }
  return points;
}

/// Copies the patches, with their points moved like those of the mesh. They must have the array VolumePointId.
void movePatches(vtkPartitionedDataSetCollection* from, const std::vector<atria::Vec3>& points,
                 vtkPartitionedDataSetCollection* to)
{
  to->SetNumberOfPartitionedDataSets(from->GetNumberOfPartitionedDataSets());
  to->GetFieldData()->PassData(from->GetFieldData());
  for (unsigned int i = 0; i < from->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkPartitionedDataSet* source = from->GetPartitionedDataSet(i);
    vtkNew<vtkPartitionedDataSet> parts;
    for (unsigned int j = 0; source && j < source->GetNumberOfPartitions(); ++j)
    {
      auto* patch = vtkPolyData::SafeDownCast(source->GetPartitionAsDataObject(j));
      if (!patch)
      {
        continue;
      }
      vtkDataArray* ids = patch->GetPointData()->GetArray("VolumePointId");
      std::vector<atria::Vec3> own(static_cast<std::size_t>(patch->GetNumberOfPoints()));
      for (std::size_t p = 0; p < own.size(); ++p)
      {
        own[p] = points[static_cast<std::size_t>(ids->GetComponent(static_cast<vtkIdType>(p), 0))];
      }
      vtkNew<vtkPolyData> moved;
      moved->ShallowCopy(patch);
      moved->SetPoints(atria::pointsToVtk(own));
      parts->SetPartition(parts->GetNumberOfPartitions(), moved);
    }
    to->SetPartitionedDataSet(i, parts);
    if (from->HasMetaData(i))
    {
      to->GetMetaData(i)->Copy(from->GetMetaData(i));
    }
  }
}

/// Adds the arrays that report moved points and remaining poor cells.
void addReport(const atria::MeshOptimizerReport& report, vtkUnstructuredGrid* before, vtkUnstructuredGrid* mesh)
{
  atria::addArrayOf<vtkFloatArray>(mesh->GetCellData(), "TargetShare", report.shares);
  auto* moves = atria::addArray<vtkDoubleArray>(mesh->GetPointData(), "Displacement", 3);
  moves->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType p = 0; p < mesh->GetNumberOfPoints(); ++p)
  {
    const atria::Vec3 move = atria::Vec3(mesh->GetPoint(p)) - atria::Vec3(before->GetPoint(p));
    moves->SetTypedTuple(p, move.data());
  }
  vtkFieldData* data = mesh->GetFieldData();
  atria::addArrayOf<vtkIdTypeArray>(data, "MovedPoints", std::array{report.movedPoints});
  atria::addArrayOf<vtkIdTypeArray>(data, "PoorCellsBefore", std::array{report.shortBefore});
  atria::addArrayOf<vtkIdTypeArray>(data, "PoorCells", std::array{report.shortAfter});
}

} // namespace

vtkAtriaMeshOptimizer::vtkAtriaMeshOptimizer()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

void vtkAtriaMeshOptimizer::SetPatchesConnection(vtkAlgorithmOutput* patches) { this->SetInputConnection(1, patches); }

void vtkAtriaMeshOptimizer::SetPatchesData(vtkPartitionedDataSetCollection* patches)
{
  this->SetInputDataInternal(1, patches);
}

vtkPartitionedDataSetCollection* vtkAtriaMeshOptimizer::GetPatches()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkAtriaMeshOptimizer::FillInputPortInformation(int port, vtkInformation* info)
{
  return atria::acceptMeshAndPatches(port, info);
}

int vtkAtriaMeshOptimizer::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkPartitionedDataSetCollection");
  return 1;
}

void vtkAtriaMeshOptimizer::CheckProperties()
{
  atriaCheckRange(FeatureAngle);
  atriaCheckRange(TargetCellSquish);
  atriaCheckRange(TargetNonOrthogonality);
  atriaCheckRange(TargetSkewness);
  atriaCheckRange(TargetScaledJacobian);
  atriaCheckRange(NumberOfSweeps);
}

vtkTypeBool vtkAtriaMeshOptimizer::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return atria::processOnRanks(*this, request, inputs, outputs,
                               [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); }, {0, 1});
}

int vtkAtriaMeshOptimizer::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkUnstructuredGrid* volume = vtkUnstructuredGrid::GetData(inputs[0], 0);
  vtkPartitionedDataSetCollection* patches = vtkPartitionedDataSetCollection::GetData(inputs[1], 0);
  this->NumberOfMovedPoints = 0;
  this->NumberOfPoorCellsBefore = 0;
  this->NumberOfPoorCells = 0;
  return atria::runFilter(*this, outputs, "Cannot improve the mesh: ", [&](const atria::RunContext& context) {
    this->CheckProperties();
    context.progress.report(0.0, "Finding faces");
    atria::VtkFaceMesh source = atria::faceMeshFromVtk(volume, patches, context.executor);
    atria::MeshOptimizerOptions options;
    options.featureAngle = this->FeatureAngle;
    options.fixedBoundary = this->FixBoundary;
    options.keptPoints = pointsOfZones(source, volume);
    options.optimizer.sweeps = this->NumberOfSweeps;
    atria::QualityTargets& targets = options.optimizer.targets;
    targets.pyramidCosine.aimAt(1.0 - this->TargetCellSquish);
    targets.faceCosine.aimAt(std::cos(this->TargetNonOrthogonality * std::numbers::pi / 180.0));
    targets.skewness.aimAt(this->TargetSkewness);
    targets.scaledJacobian = this->TargetScaledJacobian;
    const atria::MeshOptimizerReport report =
        atria::optimizeMesh(source.mesh, source.cells.view(), patchOfFaces(source), options, context.part(0.1, 0.98));
    vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs, 0);
    output->ShallowCopy(volume);
    output->SetPoints(atria::pointsToVtk(source.mesh.points));
    addReport(report, volume, output);
    if (patches)
    {
      movePatches(patches, source.mesh.points, vtkPartitionedDataSetCollection::GetData(outputs, 1));
    }
    context.progress.report(1.0, "Mesh improved");
    this->NumberOfMovedPoints = static_cast<vtkIdType>(report.movedPoints);
    this->NumberOfPoorCellsBefore = static_cast<vtkIdType>(report.shortBefore);
    this->NumberOfPoorCells = static_cast<vtkIdType>(report.shortAfter);
  });
}

void vtkAtriaMeshOptimizer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "FixBoundary: " << this->FixBoundary << "\n";
  os << indent << "TargetCellSquish: " << this->TargetCellSquish << "\n";
  os << indent << "TargetNonOrthogonality: " << this->TargetNonOrthogonality << "\n";
  os << indent << "TargetSkewness: " << this->TargetSkewness << "\n";
  os << indent << "TargetScaledJacobian: " << this->TargetScaledJacobian << "\n";
  os << indent << "NumberOfSweeps: " << this->NumberOfSweeps << "\n";
  os << indent << "NumberOfMovedPoints: " << this->NumberOfMovedPoints << "\n";
  os << indent << "NumberOfPoorCellsBefore: " << this->NumberOfPoorCellsBefore << "\n";
  os << indent << "NumberOfPoorCells: " << this->NumberOfPoorCells << "\n";
}
