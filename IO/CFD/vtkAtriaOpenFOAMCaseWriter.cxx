// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOpenFOAMCaseWriter.h"

#include "AlgorithmProgress.h"
#include "ClimateTable.h"
#include "FlowCase.h"
#include "GroundRoughness.h"
#include "OpenFOAMCase.h"
#include "OutputFolders.h"
#include "PropertyLists.h"
#include "PropertyRange.h"
#include "Support/Error.h"
#include "WindProfile.h"

#include <vtkErrorCode.h>
#include <vtkObjectFactory.h>

#include <exception>
#include <filesystem>

vtkStandardNewMacro(vtkAtriaOpenFOAMCaseWriter);

namespace {

namespace fs = std::filesystem;

/// Appends the rules that `read` finds in texts.
template <typename Read, typename Rule>
void appendRules(const std::vector<std::string>& texts, Read read, std::vector<Rule>& rules)
{
  for (const std::string& text : texts)
  {
    rules.push_back(read(text));
  }
}

void printRules(ostream& os, vtkIndent indent, const char* name, const std::vector<std::string>& rules)
{
  for (const std::string& rule : rules)
  {
    os << indent << name << ": " << rule << "\n";
  }
}

/// Returns where the wind of a climate's table blows to, degrees from x. Throws Error.
std::vector<double> directionsIn(const std::string& table, double north)
{
  try
  {
    std::vector<double> towards;
    for (const double from : atria::weather::directionsOf(atria::weather::readClimateTable(table)))
    {
      towards.push_back(atria::windTowards(from, north));
    }
    return towards;
  }
  catch (const atria::Error& error)
  {
    throw atria::Error(std::string("RoseFileName: ") + error.what());
  }
}

void copyMesh(const fs::path& source, const fs::path& target)
{
  std::error_code ignored;
  if (fs::equivalent(source, target, ignored))
  {
    return;
  }
  const fs::path from = source / "constant" / "polyMesh";
  if (!fs::is_directory(from))
  {
    throw atria::Error("'" + source.string() +
                       "' is no case of OpenFOAM with a mesh: it has no folder constant/polyMesh");
  }
  const fs::path to = target / "constant" / "polyMesh";
  const atria::UnfinishedFolder unfinished(to.parent_path() / ".unfinished");
  std::error_code error;
  fs::copy(from, unfinished.path / to.filename(), fs::copy_options::recursive, error);
  if (!error)
  {
    fs::remove_all(to, error);
  }
  if (error)
  {
    throw atria::OutputError("cannot copy the mesh to '" + to.string() + "': " + error.message());
  }
  unfinished.moveFilesTo(to.parent_path());
}

} // namespace

vtkAtriaOpenFOAMCaseWriter::vtkAtriaOpenFOAMCaseWriter() = default;

vtkAtriaOpenFOAMCaseWriter::~vtkAtriaOpenFOAMCaseWriter()
{
  delete[] this->RoseFileName;
  delete[] this->TreeFile;
}

void vtkAtriaOpenFOAMCaseWriter::AddWindAngle(double degrees)
{
  this->WindAngles.push_back(degrees);
  this->Modified();
}

void vtkAtriaOpenFOAMCaseWriter::RemoveAllWindAngles() { atria::removeAll(*this, this->WindAngles); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfWindAngles() { return atria::numberOf(this->WindAngles); }
double vtkAtriaOpenFOAMCaseWriter::GetWindAngle(int i) { return atria::entryAt(this->WindAngles, i); }

void vtkAtriaOpenFOAMCaseWriter::AddScalarRule(const char* rule) { atria::addText(*this, this->ScalarRules, rule); }
void vtkAtriaOpenFOAMCaseWriter::RemoveAllScalarRules() { atria::removeAll(*this, this->ScalarRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfScalarRules() { return atria::numberOf(this->ScalarRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetScalarRule(int i) { return atria::entryAt(this->ScalarRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddCanopyRule(const char* rule) { atria::addText(*this, this->CanopyRules, rule); }
void vtkAtriaOpenFOAMCaseWriter::RemoveAllCanopyRules() { atria::removeAll(*this, this->CanopyRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfCanopyRules() { return atria::numberOf(this->CanopyRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetCanopyRule(int i) { return atria::entryAt(this->CanopyRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddScreenRule(const char* rule) { atria::addText(*this, this->ScreenRules, rule); }
void vtkAtriaOpenFOAMCaseWriter::RemoveAllScreenRules() { atria::removeAll(*this, this->ScreenRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfScreenRules() { return atria::numberOf(this->ScreenRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetScreenRule(int i) { return atria::entryAt(this->ScreenRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddFanRule(const char* rule) { atria::addText(*this, this->FanRules, rule); }
void vtkAtriaOpenFOAMCaseWriter::RemoveAllFanRules() { atria::removeAll(*this, this->FanRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfFanRules() { return atria::numberOf(this->FanRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetFanRule(int i) { return atria::entryAt(this->FanRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddTemperatureRule(const char* rule)
{
  atria::addText(*this, this->TemperatureRules, rule);
}
void vtkAtriaOpenFOAMCaseWriter::RemoveAllTemperatureRules() { atria::removeAll(*this, this->TemperatureRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfTemperatureRules() { return atria::numberOf(this->TemperatureRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetTemperatureRule(int i) { return atria::entryAt(this->TemperatureRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddHeatRule(const char* rule) { atria::addText(*this, this->HeatRules, rule); }
void vtkAtriaOpenFOAMCaseWriter::RemoveAllHeatRules() { atria::removeAll(*this, this->HeatRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfHeatRules() { return atria::numberOf(this->HeatRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetHeatRule(int i) { return atria::entryAt(this->HeatRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddPatchRule(const char* rule) { atria::addText(*this, this->PatchRules, rule); }
void vtkAtriaOpenFOAMCaseWriter::RemoveAllPatchRules() { atria::removeAll(*this, this->PatchRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfPatchRules() { return atria::numberOf(this->PatchRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetPatchRule(int i) { return atria::entryAt(this->PatchRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddConditionRule(const char* rule)
{
  atria::addText(*this, this->ConditionRules, rule);
}
void vtkAtriaOpenFOAMCaseWriter::RemoveAllConditionRules() { atria::removeAll(*this, this->ConditionRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfConditionRules() { return atria::numberOf(this->ConditionRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetConditionRule(int i) { return atria::entryAt(this->ConditionRules, i); }

void vtkAtriaOpenFOAMCaseWriter::AddGroundRule(const char* rule) { atria::addText(*this, this->GroundRules, rule); }
void vtkAtriaOpenFOAMCaseWriter::RemoveAllGroundRules() { atria::removeAll(*this, this->GroundRules); }
int vtkAtriaOpenFOAMCaseWriter::GetNumberOfGroundRules() { return atria::numberOf(this->GroundRules); }
std::string vtkAtriaOpenFOAMCaseWriter::GetGroundRule(int i) { return atria::entryAt(this->GroundRules, i); }

bool vtkAtriaOpenFOAMCaseWriter::HasRoseFile() const { return this->RoseFileName && *this->RoseFileName; }

void vtkAtriaOpenFOAMCaseWriter::CheckProperties()
{
  this->Superclass::CheckProperties();
  if (this->GetUseRanksAsProcessors())
  {
    throw atria::Error("UseRanksAsProcessors is for the mesh alone: divide a case by NumberOfProcessors");
  }
  atriaCheckRange(Kind);
  atriaCheckRange(InletQuantity);
  atriaCheckRange(InletSpeed);
  atriaCheckRange(InletFlowRate);
  atriaCheckRange(ReferenceSpeed);
  atriaCheckRange(ReferenceHeight);
  atriaCheckRange(RoughnessLength);
  atriaCheckRange(NumberOfRoseDirections);
  atriaCheckRange(NorthAngle);
  atriaCheckRange(TurbulenceModel);
  atriaCheckRange(Dialect);
  atriaCheckRange(NumberOfIterations);
  atriaCheckRange(PedestrianHeight);
  atriaCheckRange(OutdoorTemperature);
  atriaCheckRange(TransientDuration);
  for (const double angle : this->WindAngles)
  {
    atria::checkRange("WindAngle", angle, -360.0, 360.0);
  }
  if (this->HasRoseFile() && (this->NumberOfRoseDirections > 0 || !this->WindAngles.empty()))
  {
    throw atria::Error("RoseFileName excludes NumberOfRoseDirections and WindAngles: give one of them");
  }
}

atria::FlowCaseSettings vtkAtriaOpenFOAMCaseWriter::GetSettings()
{
  atria::FlowCaseSettings settings;
  settings.kind = static_cast<atria::FlowKind>(this->Kind);
  settings.supply = this->InletQuantity == ByFlowRate ? atria::Supply{atria::Supply::FlowRate, this->InletFlowRate}
                                                      : atria::Supply{atria::Supply::Speed, this->InletSpeed};
  settings.wind = {this->ReferenceSpeed, this->ReferenceHeight, this->RoughnessLength};
  settings.north = this->NorthAngle;
  settings.directions = this->WindAngles;
  if (this->NumberOfRoseDirections > 0)
  {
    settings.directions = atria::windRose(this->NumberOfRoseDirections, this->NorthAngle);
  }
  if (this->HasRoseFile())
  {
    settings.directions = directionsIn(this->RoseFileName, this->NorthAngle);
  }
  settings.turbulence = static_cast<atria::TurbulenceModel>(this->TurbulenceModel);
  settings.dialect = static_cast<atria::OpenFOAMDialect>(this->Dialect);
  settings.iterations = this->NumberOfIterations;
  settings.processors = this->GetNumberOfProcessors();
  settings.format = this->GetFormat();
  settings.pedestrianHeight = this->PedestrianHeight;
  settings.ageOfAir = this->AgeOfAir;
  appendRules(this->ScalarRules, atria::scalarRuleFrom, settings.scalarRules);
  appendRules(this->CanopyRules, atria::canopyRuleFrom, settings.canopyRules);
  settings.treeFile = this->TreeFile ? this->TreeFile : "";
  appendRules(this->ScreenRules, atria::screenRuleFrom, settings.screenRules);
  appendRules(this->FanRules, atria::fanRuleFrom, settings.fanRules);
  settings.warmAir = this->WarmAir;
  settings.outdoorTemperature = this->OutdoorTemperature;
  appendRules(this->TemperatureRules, atria::temperatureRuleFrom, settings.temperatureRules);
  appendRules(this->HeatRules, atria::heatRuleFrom, settings.heatRules);
  settings.calm = this->Calm;
  settings.transientDuration = this->TransientDuration;
  appendRules(this->PatchRules, atria::patchRuleFrom, settings.patchRules);
  appendRules(this->GroundRules, atria::groundRuleFrom, settings.patchRules); // they hold over PatchRules
  settings.checkProfile = this->CheckProfile;
  appendRules(this->ConditionRules, atria::conditionRuleFrom, settings.conditionRules);
  return settings;
}

void vtkAtriaOpenFOAMCaseWriter::WriteFlow(const char* source)
{
  if (!this->GetCaseDirectory() || !*this->GetCaseDirectory())
  {
    vtkErrorMacro("No CaseDirectory was given.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return;
  }
  try
  {
    this->CheckProperties();
    const atria::FlowCaseSettings settings = this->GetSettings();
    const fs::path folder = this->GetCaseDirectory();
    atria::refuseResult(folder, atria::resultIn(folder));
    atria::NewFolders made({folder / "constant" / "polyMesh", folder / "system", folder / "0"});
    if (source)
    {
      copyMesh(source, folder);
      atria::completeCase(folder);
    }
    else
    {
      this->Superclass::WriteAll();
    }
    if (this->GetErrorCode() == vtkErrorCode::NoError)
    {
      const atria::AlgorithmRun run(*this);
      const atria::WrittenCase written = atria::writeFlowCase(folder, settings, run.context);
      this->WrittenKind = static_cast<int>(written.kind);
      this->Summary = written.summary;
      for (const std::string& warning : written.warnings)
      {
        vtkWarningMacro("'" << folder.string() << "': " << warning);
      }
      made.keep();
    }
  }
  catch (const atria::Aborted&)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Cannot write a case to '" << this->GetCaseDirectory() << "': " << error.what());
    this->SetErrorCode(ErrorCodeFor(error));
  }
}

void vtkAtriaOpenFOAMCaseWriter::WriteAll() { this->WriteFlow(nullptr); }

int vtkAtriaOpenFOAMCaseWriter::WriteForMesh(const char* source)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->WriteFlow(source ? source : "");
  return this->GetErrorCode() == vtkErrorCode::NoError ? 1 : 0;
}

void vtkAtriaOpenFOAMCaseWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kind: " << this->Kind << "\n";
  os << indent << "InletQuantity: " << this->InletQuantity << "\n";
  os << indent << "InletSpeed: " << this->InletSpeed << "\n";
  os << indent << "InletFlowRate: " << this->InletFlowRate << "\n";
  os << indent << "WrittenKind: " << this->WrittenKind << "\n";
  os << indent << "Summary: " << this->Summary << "\n";
  os << indent << "ReferenceSpeed: " << this->ReferenceSpeed << "\n";
  os << indent << "ReferenceHeight: " << this->ReferenceHeight << "\n";
  os << indent << "RoughnessLength: " << this->RoughnessLength << "\n";
  os << indent << "WindAngles:";
  for (const double angle : this->WindAngles)
  {
    os << " " << angle;
  }
  os << "\n" << indent << "NumberOfRoseDirections: " << this->NumberOfRoseDirections << "\n";
  os << indent << "RoseFileName: " << (this->RoseFileName ? this->RoseFileName : "(none)") << "\n";
  os << indent << "NorthAngle: " << this->NorthAngle << "\n";
  os << indent << "TurbulenceModel: " << this->TurbulenceModel << "\n";
  os << indent << "Dialect: " << this->Dialect << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "PedestrianHeight: " << this->PedestrianHeight << "\n";
  os << indent << "AgeOfAir: " << (this->AgeOfAir ? "on" : "off") << "\n";
  printRules(os, indent, "ScalarRule", this->ScalarRules);
  printRules(os, indent, "CanopyRule", this->CanopyRules);
  os << indent << "TreeFile: " << (this->TreeFile ? this->TreeFile : "(none)") << "\n";
  printRules(os, indent, "ScreenRule", this->ScreenRules);
  printRules(os, indent, "FanRule", this->FanRules);
  os << indent << "WarmAir: " << (this->WarmAir ? "on" : "off") << "\n";
  os << indent << "OutdoorTemperature: " << this->OutdoorTemperature << "\n";
  printRules(os, indent, "TemperatureRule", this->TemperatureRules);
  printRules(os, indent, "HeatRule", this->HeatRules);
  os << indent << "Calm: " << (this->Calm ? "on" : "off") << "\n";
  os << indent << "TransientDuration: " << this->TransientDuration << "\n";
  printRules(os, indent, "PatchRule", this->PatchRules);
  printRules(os, indent, "ConditionRule", this->ConditionRules);
  printRules(os, indent, "GroundRule", this->GroundRules);
  os << indent << "CheckProfile: " << (this->CheckProfile ? "on" : "off") << "\n";
}
