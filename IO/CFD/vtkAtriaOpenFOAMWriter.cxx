// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOpenFOAMWriter.h"

#include "AlgorithmProgress.h"
#include "Decomposition.h"
#include "OpenFOAMCase.h"
#include "OutputFolders.h"
#include "ProcessorFolders.h"
#include "PropertyRange.h"
#include "Ranks/ControllerExchange.h"
#include "Ranks/MeshPiece.h"
#include "Ranks/PieceCase.h"
#include "Ranks/RankProcessors.h"
#include "Ranks/VtkShares.h"

#include <vtkErrorCode.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkUnstructuredGrid.h>

#include <exception>
#include <filesystem>
#include <utility>

vtkStandardNewMacro(vtkAtriaOpenFOAMWriter);

vtkAtriaOpenFOAMWriter::vtkAtriaOpenFOAMWriter() = default;

vtkAtriaOpenFOAMWriter::~vtkAtriaOpenFOAMWriter() { delete[] this->CaseDirectory; }

std::string vtkAtriaOpenFOAMWriter::GetTarget() const { return this->CaseDirectory ? this->CaseDirectory : ""; }

const char* vtkAtriaOpenFOAMWriter::GetFormatName() const { return "an OpenFOAM case"; }

const char* vtkAtriaOpenFOAMWriter::GetTargetProperty() const { return "CaseDirectory"; }

void vtkAtriaOpenFOAMWriter::WriteSolverMesh(const atria::SolverMesh& mesh, const atria::RunContext& context)
{
  this->CheckProperties();
  if (this->NumberOfProcessors > 1 || !mesh.partOf.empty())
  {
    atria::refuseProcessorResults(this->CaseDirectory);
  }
  const std::filesystem::path folder = this->CaseDirectory;
  this->WarnOfResults();
  auto made = std::make_unique<atria::NewFolders>(
      std::vector<std::filesystem::path>{folder / "constant" / "polyMesh", folder / "system"});
  atria::completeCase(folder);
  atria::writePolyMesh(folder, mesh, this->GetFormat(), context.part(0.0, 0.5));
  this->WriteProcessors(mesh.partOf, context.part(0.5, 1.0));
  if (this->Parts)
  {
    this->Made = std::move(made);
  }
  else
  {
    made->keep();
  }
}

void vtkAtriaOpenFOAMWriter::WarnOfResults()
{
  if (const std::string result = atria::resultIn(this->CaseDirectory); !result.empty())
  {
    vtkWarningMacro("'" << this->CaseDirectory << "' holds results of a run with an earlier mesh (" << result
                        << "), which are of no use with this one");
  }
}

void vtkAtriaOpenFOAMWriter::TakeRanks(vtkMultiProcessController& controller, std::span<const std::uint32_t> rankOf)
{
  this->Ranks = controller.GetNumberOfProcesses();
  this->RankOfCells.assign(rankOf.begin(), rankOf.end());
}

std::vector<std::uint32_t> vtkAtriaOpenFOAMWriter::DivideCells(vtkUnstructuredGrid* volume,
                                                               const atria::Executor& executor)
{
  std::vector<std::uint32_t> known = std::exchange(this->RankOfCells, {});
  const auto ranks = static_cast<std::size_t>(std::exchange(this->Ranks, 1));
  if (!this->UseRanksAsProcessors || ranks == 1)
  {
    return {};
  }
  return known.empty() ? atria::divideCells(volume, ranks, executor) : known;
}

void vtkAtriaOpenFOAMWriter::WriteProcessors(const std::vector<std::uint32_t>& partOf, const atria::RunContext& context)
{
  if (!partOf.empty())
  {
    this->Parts =
        std::make_unique<atria::DividedMesh>(atria::DividedMesh{atria::readPolyMesh(this->CaseDirectory), partOf});
    return; // to WriteOnRanks()
  }
  if (this->NumberOfProcessors > 1)
  {
    atria::writeProcessors(this->CaseDirectory, atria::readPolyMesh(this->CaseDirectory),
                           static_cast<std::size_t>(this->NumberOfProcessors), this->GetFormat(), context);
  }
}

std::optional<int> vtkAtriaOpenFOAMWriter::WritePieces(vtkMultiProcessController& controller)
{
  if (!this->UseRanksAsProcessors || this->WriteWholeMesh || this->GetTarget().empty())
  {
    return std::nullopt;
  }
  auto* volume = vtkUnstructuredGrid::SafeDownCast(this->GetInputDataObject(0, 0));
  const std::optional<atria::MeshPiece> piece = atria::MeshPiece::of(volume, this->GetPatches(), controller);
  atria::ControllerExchange ranks(controller);
  const bool isFirst = ranks.rank() == 0;
  std::string hindrance = "its pieces have no ghost cells, global ids or patches";
  if (piece)
  {
    this->SetErrorCode(vtkErrorCode::NoError);
    try
    {
      ranks.run([&] { this->WritePiece(*piece, volume, ranks); });
      return 1;
    }
    catch (const atria::RanksDisagree& error)
    {
      hindrance = error.what();
    }
    catch (...)
    {
      const std::exception_ptr error = std::current_exception();
      isFirst ? this->WriteAndTell([&] { std::rethrow_exception(error); })
              : this->SetErrorCode(vtkErrorCode::UnknownError);
      return 1;
    }
  }
  if (isFirst)
  {
    vtkWarningMacro("'" << this->GetTarget() << "': the whole mesh is written, too: " << hindrance);
  }
  return std::nullopt;
}

void vtkAtriaOpenFOAMWriter::WritePiece(const atria::MeshPiece& piece, vtkUnstructuredGrid* volume,
                                        atria::RankExchange& ranks)
{
  this->CheckProperties();
  if (ranks.rank() == 0)
  {
    atria::refuseProcessorResults(this->CaseDirectory);
    this->WarnOfResults();
  }
  const atria::AlgorithmRun run(*this);
  const atria::PieceCase target{this->CaseDirectory, this->GetFormat(), this->GetMergeUnderdeterminedCells(),
                                this->GetMergeCoplanarFaces(),
                                [&](atria::FaceMesh& mesh) { this->Place(volume, mesh); }};
  const atria::WrittenPieces written = atria::writePieces(target, piece, volume, ranks, run.context);
  this->Tell(written.verdict, written.mergedCells, written.addedCells, written.mergedFaces);
  if (ranks.rank() > 0)
  {
    return;
  }
  for (const std::string& failure : written.failures)
  {
    vtkWarningMacro("'" << this->GetTarget() << "': " << failure);
  }
  if (!written.hasNumbers)
  {
    vtkWarningMacro("'" << this->GetTarget()
                        << "': the mesh is too large for labels of 32 bits to tell what processors "
                        << "have of it: reconstructPar cannot be used");
  }
}

bool vtkAtriaOpenFOAMWriter::WriteOnRanks(vtkMultiProcessController& controller)
{
  if (!this->UseRanksAsProcessors)
  {
    return true;
  }
  const atria::AlgorithmRun run(*this);
  const bool written = atria::writeProcessorsOnRanks(this->CaseDirectory, this->Parts.get(), this->GetFormat(),
                                                     controller, run.context.progress);
  if (this->Made && written)
  {
    this->Made->keep();
  }
  return written;
}

void vtkAtriaOpenFOAMWriter::LeaveRanks()
{
  this->Parts.reset();
  this->Made.reset();
}

void vtkAtriaOpenFOAMWriter::CheckProperties() { atriaCheckRange(NumberOfProcessors); }

atria::OpenFOAMFormat vtkAtriaOpenFOAMWriter::GetFormat() const
{
  return this->WriteBinary ? atria::OpenFOAMFormat::Binary : atria::OpenFOAMFormat::Ascii;
}

void vtkAtriaOpenFOAMWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "WriteBinary: " << (this->WriteBinary ? "on" : "off") << "\n";
  os << indent << "NumberOfProcessors: " << this->NumberOfProcessors << "\n";
  os << indent << "UseRanksAsProcessors: " << (this->UseRanksAsProcessors ? "on" : "off") << "\n";
  os << indent << "WriteWholeMesh: " << (this->WriteWholeMesh ? "on" : "off") << "\n";
}
