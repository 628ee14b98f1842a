// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaWeatherReader.h"

#include "AddArray.h"
#include "ClimateTable.h"
#include "PropertyRange.h"
#include "Ranks/Ranks.h"
#include "Support/Error.h"
#include "WeatherClimate.h"

#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <exception>
#include <new>

vtkStandardNewMacro(vtkAtriaWeatherReader);

namespace {

namespace weather = atria::weather;

void addStatistics(vtkFieldData* data, const weather::Climate& climate)
{
  const auto addNumber = [&](const char* name, double value) {
    atria::addArray<vtkDoubleArray>(data, name)->InsertNextValue(value);
  };
  const auto addCount = [&](const char* name, std::size_t count) {
    atria::addArray<vtkIdTypeArray>(data, name)->InsertNextValue(static_cast<vtkIdType>(count));
  };
  const weather::Station& station = climate.weather.station;
  atria::addArray<vtkStringArray>(data, "StationName")->InsertNextValue(station.name);
  addNumber("Latitude", station.latitude);
  addNumber("Longitude", station.longitude);
  addNumber("Elevation", station.elevation);
  addCount("HoursRead", climate.weather.hours.size());
  addCount("HoursKept", climate.kept);
  addCount("VentilationHours", climate.ventilated.inRange);
  addCount("VentilationHoursKnown", climate.ventilated.known);
  addCount("CalmHours", climate.rose.calms);
  addNumber("MeanSpeed", climate.rose.meanSpeed);
}

void fill(vtkTable* table, const weather::Climate& climate)
{
  using weather::ClimateSector;
  const std::vector<ClimateSector> sectors = weather::tableOf(climate.rose);
  vtkDataSetAttributes* const rows = table->GetRowData();
  atria::addArrayOf<vtkDoubleArray>(rows, "from", sectors, &ClimateSector::from);
  atria::addArrayOf<vtkDoubleArray>(rows, "frequency", sectors, &ClimateSector::frequency);
  atria::addArrayOf<vtkDoubleArray>(rows, "scale", sectors, &ClimateSector::scale);
  atria::addArrayOf<vtkDoubleArray>(rows, "shape", sectors, &ClimateSector::shape);
  addStatistics(table->GetFieldData(), climate);
}

} // namespace

vtkAtriaWeatherReader::vtkAtriaWeatherReader()
{
  this->SetNumberOfInputPorts(0);
  const weather::TemperatureRange temperature; // the homes of the defaults
  const weather::HoursOfDay hours;
  const weather::RoseOptions rose;
  this->TemperatureRange[0] = temperature.least;
  this->TemperatureRange[1] = temperature.most;
  this->Hours[0] = hours.from;
  this->Hours[1] = hours.to;
  this->Sectors = rose.sectors;
  this->CalmSpeed = rose.calmSpeed;
}

vtkAtriaWeatherReader::~vtkAtriaWeatherReader() { delete[] this->FileName; }

bool vtkAtriaWeatherReader::CanReadFile(const char* fileName) { return fileName && weather::isWeather(fileName); }

vtkTypeBool vtkAtriaWeatherReader::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return atria::processOnRanks(*this, request, inputs, outputs,
                               [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

void vtkAtriaWeatherReader::CheckProperties()
{
  atriaCheckRange(Season);
  atriaCheckRange(Sectors);
  atriaCheckRange(CalmSpeed);
  for (const double temperature : this->TemperatureRange)
  {
    atria::checkRange("TemperatureRange", temperature, -1e30, 1e30);
  }
  for (const int hour : this->Hours)
  {
    atria::checkRange("Hours", hour, 0, 24);
  }
}

weather::ClimateOptions vtkAtriaWeatherReader::GetOptions()
{
  weather::ClimateOptions options;
  options.ventilation = {this->TemperatureRange[0], this->TemperatureRange[1]};
  options.onlyVentilated = this->UseTemperatureRange;
  options.time = {this->Hours[0], this->Hours[1]};
  if (this->Season != AllSeasons)
  {
    options.season = static_cast<weather::Season>(this->Season - Spring);
  }
  if (!this->Months.empty())
  {
    options.months = weather::monthsFrom(this->Months);
  }
  options.rose = {this->Sectors, this->CalmSpeed};
  return options;
}

int vtkAtriaWeatherReader::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkTable* const output = vtkTable::GetData(outputs);
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("FileName is not set");
    return 0;
  }
  try
  {
    this->CheckProperties();
    const weather::Climate climate = weather::readClimate(this->FileName, this->GetOptions());
    for (const atria::Warning& doubt : weather::doubtsOf(climate))
    {
      if (doubt.gravity == atria::Gravity::grave)
      {
        vtkWarningMacro("'" << this->FileName << "': " << doubt.text);
      }
    }
    fill(output, climate);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("not enough memory to read '" << this->FileName << "'");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  output->Initialize();
  return 0;
}

void vtkAtriaWeatherReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "UseTemperatureRange: " << (this->UseTemperatureRange ? "on" : "off") << "\n";
  os << indent << "TemperatureRange: " << this->TemperatureRange[0] << " to " << this->TemperatureRange[1] << "\n";
  os << indent << "Hours: " << this->Hours[0] << " to " << this->Hours[1] << "\n";
  os << indent << "Season: " << this->Season << "\n";
  os << indent << "Months: " << this->Months << "\n";
  os << indent << "Sectors: " << this->Sectors << "\n";
  os << indent << "CalmSpeed: " << this->CalmSpeed << "\n";
}
