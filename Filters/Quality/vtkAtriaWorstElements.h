// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that extracts the worst elements of a mesh.
/**
 * @class   vtkAtriaWorstElements
 * @brief   the worst elements of a mesh by a cell array, and the elements around them
 *
 * Takes an unstructured grid with a cell array of numbers, such as vtkAtriaMeshQuality makes, and returns the elements
 * with the worst values together with Rings rings of elements around them. Elements that share a point are neighbors. A
 * sheet with fluid on both sides has separate points on each side, so a ring does not reach across it.
 *
 * The array is chosen with SetMetricName(), by default `CellSquish`. Order determines which values are worst: by
 * default it depends on the metric of vtkAtriaMeshQuality; for any other array the greatest is worst. Elements whose
 * value is not a number are never among the worst.
 *
 * The output is an unstructured grid with the cells in the order of their rank, then ring by ring. It keeps all cell,
 * point and field arrays of the input, and adds
 * - `WorstRank` (int, cells): 1 for the worst and so on; 0 in the rings
 * - `Ring` (int, cells): 0 for the worst, 1 for those that touch them, and so on
 * - `vtkOriginalCellIds`, `vtkOriginalPointIds` (id): the cell and point in the input
 *
 * A mesh without the array is an error that names the existing arrays. The output is empty if no value is beyond the
 * limit.
 *
 * @sa vtkAtriaMeshQuality
 */
#ifndef vtkAtriaWorstElements_h
#define vtkAtriaWorstElements_h

#include "AtriaFiltersQualityModule.h"
#include "vtkAtriaRangeMacros.h" // For properties with a range
#include "vtkUnstructuredGridAlgorithm.h"

#include <string>

class ATRIAFILTERSQUALITY_EXPORT vtkAtriaWorstElements : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkAtriaWorstElements* New();
  vtkTypeMacro(vtkAtriaWorstElements, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Orders
  {
    Automatic = 0,     ///< depends on the metric
    GreatestFirst = 1, ///< the greatest is worst
    SmallestFirst = 2  ///< the smallest is worst
  };

  ///@{
  /**
   * Name of the cell array to sort by. Only the first component of an array counts. Default `CellSquish`.
   */
  vtkSetMacro(MetricName, std::string);
  vtkGetMacro(MetricName, std::string);
  ///@}

  ///@{
  /**
   * Which values are worst. Default Automatic.
   */
  vtkAtriaSetInRangeMacro(Order, int, Automatic, SmallestFirst);
  vtkGetMacro(Order, int);
  void SetOrderToAutomatic() { this->SetOrder(Automatic); }
  void SetOrderToGreatestFirst() { this->SetOrder(GreatestFirst); }
  void SetOrderToSmallestFirst() { this->SetOrder(SmallestFirst); }
  ///@}

  ///@{
  /**
   * Number of worst elements, at least 1. Not used if UseLimit is on. Default 10.
   */
  vtkAtriaSetInRangeMacro(NumberOfElements, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfElements, int);
  ///@}

  ///@{
  /**
   * If on, take all elements whose value is beyond Limit: above it if the greatest is worst, else below it. Default
   * off: the worst NumberOfElements.
   */
  vtkSetMacro(UseLimit, bool);
  vtkGetMacro(UseLimit, bool);
  vtkBooleanMacro(UseLimit, bool);
  ///@}

  ///@{
  /**
   * The limit, in the unit of the array. Not used if UseLimit is off. Default 0.9.
   */
  vtkAtriaSetInRangeMacro(Limit, double, VTK_DOUBLE_MIN, VTK_DOUBLE_MAX);
  vtkGetMacro(Limit, double);
  ///@}

  ///@{
  /**
   * Number of rings of elements around the worst, from 0 to 100. Default 1.
   */
  vtkAtriaSetInRangeMacro(Rings, int, 0, 100);
  vtkGetMacro(Rings, int);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkAtriaWorstElements() = default;
  ~vtkAtriaWorstElements() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkAtriaWorstElements(const vtkAtriaWorstElements&) = delete;
  void operator=(const vtkAtriaWorstElements&) = delete;

  std::string MetricName = "CellSquish";
  int Order = Automatic;
  int NumberOfElements = 10;
  bool UseLimit = false;
  double Limit = 0.9;
  int Rings = 1;
};

#endif
