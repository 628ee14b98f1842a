// SPDX-License-Identifier: GPL-3.0-or-later
/// Reader that makes the table of the wind's climate from a weather file, as `atria climate` does.
/**
 * @class   vtkAtriaWeatherReader
 * @brief   reads a year's weather, EPW or TMY3, as a wind rose
 *
 * The properties select hours of the file, and the output is the table of their wind, with one row a sector. Written as
 * CSV it serves `atria report --climate`, and as RoseFileName of vtkAtriaOpenFOAMCaseWriter.
 *
 * Columns (vtkDoubleArray):
 * - `from`: middle of the sector, where the wind comes from, degrees clockwise from north
 * - `frequency`: share of hours, 0 to 1, with the sector's part of the calm ones
 * - `scale` (m/s) and `shape` of the Weibull distribution of speeds
 *
 * Field data, one value each:
 * - `StationName` (vtkStringArray), `Latitude` and `Longitude` (degrees), `Elevation` (meters)
 * - `HoursRead` and `HoursKept` (vtkIdTypeArray): hours of the file, and those that the rose is made of
 * - `VentilationHours` (vtkIdTypeArray): hours selected by month and time whose temperature allows natural ventilation,
 *   within TemperatureRange; of `VentilationHoursKnown`, whose temperature is known
 * - `CalmHours` (vtkIdTypeArray) and `MeanSpeed` (m/s, calm hours included), of the hours kept
 *
 * Many missing values, and sectors that do not suit rounded directions, are warnings. A file that cannot be read is an
 * error that names file and line.
 *
 * @sa vtkAtriaOpenFOAMCaseWriter
 */
#ifndef vtkAtriaWeatherReader_h
#define vtkAtriaWeatherReader_h

#include "AtriaIOClimateModule.h" // For export macro
#include "vtkAtriaRangeMacros.h"  // For properties with a range
#include "vtkTableAlgorithm.h"

#include <string> // for Months

namespace atria {
namespace weather {
struct ClimateOptions;
}
} // namespace atria

class ATRIAIOCLIMATE_EXPORT vtkAtriaWeatherReader : public vtkTableAlgorithm
{
public:
  static vtkAtriaWeatherReader* New();
  vtkTypeMacro(vtkAtriaWeatherReader, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The weather file: EPW of EnergyPlus or TMY3 of NREL. None by default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * True if a file begins as EPW or TMY3 do.
   */
  static bool CanReadFile(const char* fileName);

  ///@{
  /**
   * Keep only hours with temperatures in TemperatureRange. Default off.
   */
  vtkSetMacro(UseTemperatureRange, bool);
  vtkGetMacro(UseTemperatureRange, bool);
  vtkBooleanMacro(UseTemperatureRange, bool);
  ///@}

  ///@{
  /**
   * Outdoor temperatures, both ends included, degrees Celsius. Without UseTemperatureRange they only say which hours
   * count as VentilationHours. Default 18 to 26.
   */
  vtkSetVector2Macro(TemperatureRange, double);
  vtkGetVector2Macro(TemperatureRange, double);
  ///@}

  ///@{
  /**
   * Keep hours between these two times of day, full hours from 0 to 24, over midnight if the first is later. Default 0
   * and 24, all.
   */
  vtkSetVector2Macro(Hours, int);
  vtkGetVector2Macro(Hours, int);
  ///@}

  enum Seasons
  {
    AllSeasons,
    Spring,
    Summer,
    Autumn,
    Winter
  };

  ///@{
  /**
   * Keep the three months of a season. Spring begins in March, in the southern hemisphere in September. Default
   * AllSeasons.
   */
  vtkAtriaSetInRangeMacro(Season, int, AllSeasons, Winter);
  vtkGetMacro(Season, int);
  ///@}

  ///@{
  /**
   * Keep these months, such as `4-9`, `11-2` (over the new year) or `1,6-8`. With a season it is an error. Default
   * empty, all months.
   */
  vtkSetMacro(Months, std::string);
  vtkGetMacro(Months, std::string);
  ///@}

  ///@{
  /**
   * Number of equal sectors of the rose, the first around north. Default 12, from 4 to 72.
   */
  vtkAtriaSetInRangeMacro(Sectors, int, 4, 72);
  vtkGetMacro(Sectors, int);
  ///@}

  ///@{
  /**
   * Hours with a lower speed, m/s, are calm: they have no direction, and are shared out among the sectors. Default 0.5.
   */
  vtkAtriaSetInRangeMacro(CalmSpeed, double, 0.0, 1e30);
  vtkGetMacro(CalmSpeed, double);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkAtriaWeatherReader();
  ~vtkAtriaWeatherReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkAtriaWeatherReader(const vtkAtriaWeatherReader&) = delete;
  void operator=(const vtkAtriaWeatherReader&) = delete;

  void CheckProperties();
  atria::weather::ClimateOptions GetOptions();

  char* FileName = nullptr;
  bool UseTemperatureRange = false;
  double TemperatureRange[2];
  int Hours[2];
  int Season = AllSeasons;
  std::string Months;
  int Sectors;
  double CalmSpeed;
};

#endif
