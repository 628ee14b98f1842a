// SPDX-License-Identifier: GPL-3.0-or-later
/// Writer that adds a complete simpleFoam case, of wind or of a ventilated room, to a mesh.
/**
 * @class   vtkAtriaOpenFOAMCaseWriter
 * @brief   writes an OpenFOAM case of wind around and through buildings, or of a ventilated room, that runs as it is
 *
 * Inputs are those of vtkAtriaOpenFOAMWriter, which writes the mesh. Beside it this writer puts the folders 0, constant
 * and system for steady Reynolds-averaged flow by simpleFoam (incompressible, turbulent), the scripts Allrun and
 * Allclean, and case.json, which describes the case to `atria report`.
 *
 * The wind is the neutral boundary layer of Richards and Hoxey (1993), given by a reference speed at a reference height
 * and a roughness length; the ground has the wall function of the same length. Without a rule patches become
 * - inlet, outlet or slip: plane, upright sides of the domain, by their angle to the wind;
 * - slip: the top of the domain;
 * - ground: patches that close the domain below, also a wall that reaches its sides;
 * - walls: all others.
 *
 * PatchRules override this by name, ConditionRules give entries of one field, and GroundRules make patches ground with
 * roughness lengths of their own.
 *
 * A mesh whose sides are all walls, and whose openings are inlets and outlets by name or by PatchRules, becomes a room.
 * Each inlet blows along its own inward normal, by InletSpeed or InletFlowRate or its rule. Outlets have the pressure
 * 0, and air that comes back in there starts at rest; all other patches are walls. A room has no wind. Words in names
 * that make a patch an inlet are inlet, inflow, supply and diffuser; those for outlets are outlet, outflow, exhaust,
 * extract and return, whatever their capitals, such as Inlet_1. Names that also have a word such as wall, duct, frame
 * or power are neither. Kind overrides this.
 *
 * With several wind directions each has a folder `wind_<degrees it comes from>` of its own, which shares the mesh by a
 * link. Schemes and relaxation follow from the largest non-orthogonality of the mesh. While the case runs it measures
 * the flow through every face zone and every open side, forces on walls, and speeds at pedestrian height.
 *
 * Besides the errors of vtkAtriaOpenFOAMWriter, these are errors: a rule that matches no patch, a mesh without a patch
 * that lets air in, or without one that lets it out, a room with wind angles, and a folder that holds results of a run.
 * Write() returns 0 then. Warnings report inlets that the wind does not enter, sheets that blow from both sides,
 * grounds whose roughness length is more than half of the height of the first cells, and a ground upstream that is
 * rougher or smoother than the wind's profile by more than a factor of 2.
 *
 * @sa vtkAtriaOpenFOAMWriter
 */
#ifndef vtkAtriaOpenFOAMCaseWriter_h
#define vtkAtriaOpenFOAMCaseWriter_h

#include "vtkAtriaOpenFOAMWriter.h"
#include "vtkAtriaRangeMacros.h"

#include <string> // for PatchRules
#include <vector> // for PatchRules

namespace atria {
struct FlowCaseSettings;
} // namespace atria

class ATRIAIOCFD_EXPORT vtkAtriaOpenFOAMCaseWriter : public vtkAtriaOpenFOAMWriter
{
public:
  static vtkAtriaOpenFOAMCaseWriter* New();
  vtkTypeMacro(vtkAtriaOpenFOAMCaseWriter, vtkAtriaOpenFOAMWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Kinds
  {
    Automatic,
    Wind,
    Room
  };
  ///@{
  /**
   * The cause of the flow: Wind, or the inlets of a Room. Automatic, the default, is Room if no wind angles are given,
   * a patch is an inlet or an outlet by its name or by a rule, and all others are walls, except for a missing floor.
   */
  vtkAtriaSetInRangeMacro(Kind, int, Automatic, Room);
  vtkGetMacro(Kind, int);
  ///@}

  enum InletQuantities
  {
    BySpeed,
    ByFlowRate
  };
  ///@{
  /**
   * Quantity that sets the flow of a room's inlets: InletSpeed (the default) or InletFlowRate. PatchRules override it
   * for single inlets.
   */
  vtkAtriaSetInRangeMacro(InletQuantity, int, BySpeed, ByFlowRate);
  vtkGetMacro(InletQuantity, int);
  ///@}

  ///@{
  /**
   * Speed of the air from each inlet of a room, m/s. Default 1.
   */
  vtkAtriaSetInRangeMacro(InletSpeed, double, 1e-6, 1000.0);
  vtkGetMacro(InletSpeed, double);
  ///@}

  ///@{
  /**
   * Air from each inlet of a room, m3/s. Default 0.05.
   */
  vtkAtriaSetInRangeMacro(InletFlowRate, double, 1e-9, 1e6);
  vtkGetMacro(InletFlowRate, double);
  ///@}

  ///@{
  /**
   * Kind of the case that was written last: Wind or Room; Automatic before the first. Summary is a sentence about the
   * flow in and out of a room, with a line about trees, and empty for wind without trees.
   */
  vtkGetMacro(WrittenKind, int);
  vtkGetMacro(Summary, std::string);
  ///@}

  ///@{
  /**
   * Speed of the wind at ReferenceHeight, m/s. Default 5.
   */
  vtkAtriaSetInRangeMacro(ReferenceSpeed, double, 1e-3, 1000.0);
  vtkGetMacro(ReferenceSpeed, double);
  ///@}

  ///@{
  /**
   * Height above the ground at which the wind has ReferenceSpeed, meters. Default 10.
   */
  vtkAtriaSetInRangeMacro(ReferenceHeight, double, 1e-3, VTK_DOUBLE_MAX);
  vtkGetMacro(ReferenceHeight, double);
  ///@}

  ///@{
  /**
   * Roughness length z0 of the ground, meters: some 0.0002 over water, 0.03 over grass, 0.1 over farmland, 0.5 in
   * suburbs, 1 and more in cities. Default 0.1.
   */
  vtkAtriaSetInRangeMacro(RoughnessLength, double, 1e-9, 100.0);
  vtkGetMacro(RoughnessLength, double);
  ///@}

  ///@{
  /**
   * Directions the wind blows to, degrees from x, counterclockwise from above; one run each. None, the default, is one
   * run from the domain's xMin to its xMax, or into its domainSide1, or along x if it has no such sides.
   */
  void AddWindAngle(double degrees);
  void RemoveAllWindAngles();
  int GetNumberOfWindAngles();
  double GetWindAngle(int i);
  ///@}

  ///@{
  /**
   * Runs for this many directions at equal steps, the first with wind from north, instead of WindAngles; 0, the
   * default, is none.
   */
  vtkAtriaSetInRangeMacro(NumberOfRoseDirections, int, 0, 360);
  vtkGetMacro(NumberOfRoseDirections, int);
  ///@}

  ///@{
  /**
   * Table of the wind's climate, as `atria climate` and vtkAtriaWeatherReader make it: a .csv with the columns from
   * (degrees clockwise from north), frequency, scale and shape, or a .json list of objects with these keys. Runs for
   * the directions with a frequency above 0, in place of WindAngles and NumberOfRoseDirections; with any of these it is
   * an error. No default.
   */
  vtkSetFilePathMacro(RoseFileName);
  vtkGetFilePathMacro(RoseFileName);
  ///@}

  ///@{
  /**
   * Direction of north, degrees from y, counterclockwise from above. Default 0.
   */
  vtkAtriaSetInRangeMacro(NorthAngle, double, -360.0, 360.0);
  vtkGetMacro(NorthAngle, double);
  ///@}

  enum TurbulenceModels
  {
    KEpsilon,
    RealizableKEpsilon,
    KOmegaSST
  };
  ///@{
  /**
   * Model of turbulence. Default RealizableKEpsilon.
   */
  vtkAtriaSetInRangeMacro(TurbulenceModel, int, KEpsilon, KOmegaSST);
  vtkGetMacro(TurbulenceModel, int);
  ///@}

  enum Dialects
  {
    OpenCFD1912, ///< v1912, which Debian 12 has
    OpenCFD,     ///< v2006 and later
    Foundation,  ///< 11 to 13
    Foundation14 ///< 14 and later
  };
  ///@{
  /**
   * The OpenFOAM distribution and version that the case is for. Default OpenCFD1912.
   */
  vtkAtriaSetInRangeMacro(Dialect, int, OpenCFD1912, Foundation14);
  vtkGetMacro(Dialect, int);
  ///@}

  ///@{
  /**
   * Maximum number of iterations of the solver. Default 1000.
   */
  vtkAtriaSetInRangeMacro(NumberOfIterations, int, 1, 10000000);
  vtkGetMacro(NumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Height above the ground of the probes for speeds, meters. Default 1.75.
   */
  vtkAtriaSetInRangeMacro(PedestrianHeight, double, 1e-3, 1000.0);
  vtkGetMacro(PedestrianHeight, double);
  ///@}

  ///@{
  /**
   * Also compute the age of the air, seconds since it came into the domain. Off by default.
   */
  vtkSetMacro(AgeOfAir, bool);
  vtkGetMacro(AgeOfAir, bool);
  vtkBooleanMacro(AgeOfAir, bool);
  ///@}

  ///@{
  /**
   * Passive scalars that the air carries, such as CO2 or smoke, as `NAME PATTERN AMOUNT`. An amount with `/s` is a
   * source, units per second, spread over the volume of the cell zones that match the pattern, or else over the area of
   * the walls: `CO2 Office 5e-6/s`. An amount without it is the concentration of the air that comes in there: `CO2
   * Inlet 400e-6`. Several sources of one scalar add up. None by default.
   */
  void AddScalarRule(const char* rule);
  void RemoveAllScalarRules();
  int GetNumberOfScalarRules();
  std::string GetScalarRule(int i);
  ///@}

  ///@{
  /**
   * Cell zones with leaves that slow the air, as `PATTERN LAD CD`: leaf area density in 1/m, one side of the leaves,
   * and their drag coefficient, such as `Hedge 2 0.2`. The last of several rules for a zone holds. With
   * KEpsilon leaves are sources of turbulence too; a warning says that other models have none. None by default.
   */
  void AddCanopyRule(const char* rule);
  void RemoveAllCanopyRules();
  int GetNumberOfCanopyRules();
  std::string GetCanopyRule(int i);
  ///@}

  ///@{
  /**
   * A table of trees: lines of `x, y, height, crown radius, LAD, Cd`, meters. Cells whose centers are in the crowns,
   * ellipsoids from a third of the height up, become canopies, the cell zones `trees` of the case's mesh. Warnings
   * report trees smaller than cells. No default.
   */
  vtkSetFilePathMacro(TreeFile);
  vtkGetFilePathMacro(TreeFile);
  ///@}

  ///@{
  /**
   * Porous screens in face zones, such as insect screens, as `PATTERN RESISTANCE`: the loss coefficient K, with which
   * the pressure falls by K rho U^2 / 2, such as `Window 2.5`; or with a linear part in Pa for each m/s, such as
   * `Window 2.5,0.4`. The zones must be plane. The last of several rules for a zone holds. None by default.
   */
  void AddScreenRule(const char* rule);
  void RemoveAllScreenRules();
  int GetNumberOfScreenRules();
  std::string GetScreenRule(int i);
  ///@}

  ///@{
  /**
   * The air has a temperature: it takes up heat, and rises where it is warmer than the air outdoors. Off by default.
   * OpenCFD's dialects alone.
   */
  vtkSetMacro(WarmAir, bool);
  vtkGetMacro(WarmAir, bool);
  vtkBooleanMacro(WarmAir, bool);
  ///@}

  ///@{
  /**
   * Fans in face zones, as `PATTERN PRESSURE` or `PATTERN FILE`: the pressure rise along the zone's normal in Pa, such
   * as `Fan 20`, or a table with lines of flow rate (m3/s, rising) and pressure (Pa, falling). Negative pressures blow
   * against the normal. The zones must be plane. The last of several rules for a zone holds. None by default.
   */
  void AddFanRule(const char* rule);
  void RemoveAllFanRules();
  int GetNumberOfFanRules();
  std::string GetFanRule(int i);
  ///@}

  ///@{
  /**
   * Temperature of the air outdoors, at the start and of what comes in, degrees Celsius. Default 20.
   */
  vtkAtriaSetInRangeMacro(OutdoorTemperature, double, -90.0, 60.0);
  vtkGetMacro(OutdoorTemperature, double);
  ///@}

  ///@{
  /**
   * Temperatures of surfaces, or of the air that comes in at inlets and openings, as `PATTERN CELSIUS`. The last of
   * several rules for a patch holds. None by default: no heat passes surfaces, and air comes in as outdoors.
   */
  void AddTemperatureRule(const char* rule);
  void RemoveAllTemperatureRules();
  int GetNumberOfTemperatureRules();
  std::string GetTemperatureRule(int i);
  ///@}

  ///@{
  /**
   * Heat that the cell zones whose name matches give to the air, or else the surfaces, as `PATTERN AMOUNT`: `Office
   * 600W` is the heat of all that match, `Floor 50W/m2` that of a square meter of surface. Negative heat cools. Several
   * rules add up. None by default.
   */
  void AddHeatRule(const char* rule);
  void RemoveAllHeatRules();
  int GetNumberOfHeatRules();
  std::string GetHeatRule(int i);
  ///@}

  ///@{
  /**
   * No wind moves the air, only warmth, fans and inlets of a given amount do: sides and top of the domain are open to
   * air at rest, and so are a room's other inlets and outlets. Needs WarmAir. Off by default.
   */
  vtkSetMacro(Calm, bool);
  vtkGetMacro(Calm, bool);
  vtkBooleanMacro(Calm, bool);
  ///@}

  ///@{
  /**
   * Seconds that a transient run computes, from air at rest; 0, the default, is a steady run. Needs WarmAir.
   */
  vtkAtriaSetInRangeMacro(TransientDuration, double, 0.0, 1e6);
  vtkGetMacro(TransientDuration, double);
  ///@}

  ///@{
  /**
   * Roles of patches, as `PATTERN ROLE`. The pattern (* and ? stand for text) is in double quotes if it holds blanks.
   * Roles are inlet, inlet:AMOUNT (which blows along its normal; m/s, m3/s, m3/h or l/s, such as inlet:0.5m/s), outlet,
   * inletOutlet (by the flow), slip, ground, wall or rough:SIZE (a wall with sand grains of that height, meters). The
   * last of several rules for a patch holds. None by default.
   */
  void AddPatchRule(const char* rule);
  void RemoveAllPatchRules();
  int GetNumberOfPatchRules();
  std::string GetPatchRule(int i);
  ///@}

  ///@{
  /**
   * Conditions of patches in one field, as `PATTERN FIELD ENTRIES`, such as `Fan* U type fixedValue; value uniform (1 0
   * 0);`. Fields are U, p, k, epsilon or omega, nut, age, T and scalars. None by default.
   */
  void AddConditionRule(const char* rule);
  void RemoveAllConditionRules();
  int GetNumberOfConditionRules();
  std::string GetConditionRule(int i);
  ///@}

  ///@{
  /**
   * Roughness lengths of grounds, as `PATTERN LENGTH` (meters) or `PATTERN KIND`: patches whose name matches become
   * ground with that length, and all others keep RoughnessLength, also the wind's profile. Kinds are those of Davenport
   * and Wieringa: water 0.0002, smooth 0.005, grass 0.03, crops 0.1, highCrops 0.25, parkland 0.5, suburb 1, forest 1,
   * city 2. The last of several rules for a patch holds; ground rules hold over PatchRules. None by default.
   */
  void AddGroundRule(const char* rule);
  void RemoveAllGroundRules();
  int GetNumberOfGroundRules();
  std::string GetGroundRule(int i);
  ///@}

  ///@{
  /**
   * Also write the folder `empty_domain`: a run of less than a minute for the domain without buildings, with cells as
   * high as the mesh's at ground and top. It says how far the wind's profile changes before the buildings; `atria
   * report` compares. Each wind direction has its own. Rooms have none. Off by default.
   */
  vtkSetMacro(CheckProfile, bool);
  vtkGetMacro(CheckProfile, bool);
  vtkBooleanMacro(CheckProfile, bool);
  ///@}

  /**
   * Writes the case for an existing mesh: that of the OpenFOAM case in the folder `source`, which is copied unless it
   * is CaseDirectory. Inputs are not used. Returns 1, or 0 after an error.
   */
  int WriteForMesh(const char* source);

protected:
  vtkAtriaOpenFOAMCaseWriter();
  ~vtkAtriaOpenFOAMCaseWriter() override;

  void WriteAll() override;
  /// Writes nothing: the processors of the case are written as a whole, once its patches have their types.
  void WriteProcessors(const std::vector<std::uint32_t>&, const atria::RunContext&) override {}

private:
  vtkAtriaOpenFOAMCaseWriter(const vtkAtriaOpenFOAMCaseWriter&) = delete;
  void operator=(const vtkAtriaOpenFOAMCaseWriter&) = delete;

  void CheckProperties() override;
  void WriteFlow(const char* source);
  atria::FlowCaseSettings GetSettings();
  bool HasRoseFile() const;

  int Kind = Automatic;
  int InletQuantity = BySpeed;
  double InletSpeed = 1.0;
  double InletFlowRate = 0.05;
  int WrittenKind = Automatic;
  std::string Summary;
  double ReferenceSpeed = 5.0;
  double ReferenceHeight = 10.0;
  double RoughnessLength = 0.1;
  std::vector<double> WindAngles;
  int NumberOfRoseDirections = 0;
  char* RoseFileName = nullptr;
  double NorthAngle = 0.0;
  int TurbulenceModel = RealizableKEpsilon;
  int Dialect = OpenCFD1912;
  int NumberOfIterations = 1000;
  double PedestrianHeight = 1.75;
  bool AgeOfAir = false;
  std::vector<std::string> ScalarRules;
  std::vector<std::string> CanopyRules;
  char* TreeFile = nullptr;
  std::vector<std::string> ScreenRules;
  std::vector<std::string> FanRules;
  bool WarmAir = false;
  double OutdoorTemperature = 20.0;
  std::vector<std::string> TemperatureRules;
  std::vector<std::string> HeatRules;
  bool Calm = false;
  double TransientDuration = 0.0;
  std::vector<std::string> PatchRules;
  std::vector<std::string> ConditionRules;
  std::vector<std::string> GroundRules;
  bool CheckProfile = false;
};

#endif
