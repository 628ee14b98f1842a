// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that extracts the feature curves and corners that a mesh has to keep.
/**
 * @class   vtkAtriaFeatureGraph
 * @brief   curves and corners of surfaces that a mesh has to keep
 *
 * Takes surfaces through the first stage of the mesher and shows what it then sees: points welded, degenerate and
 * repeated triangles dropped, coordinates near the domain's sides put on them. Curves are boundary edges, creases
 * sharper than FeatureAngle, junctions of three triangles and more, and borders between named surfaces; corners are
 * points where curves end, meet or turn sharply. Edges of the domain box are no curves, as a mesh has them anyway.
 * Sizes and domain matter only for the tolerance at which points are merged, and for the domain's sides.
 *
 * Input port 0: surfaces; see vtkAtriaGridAlgorithm.
 *
 * Output port 0, Curves: a vertex for each corner, then a line for each edge of a curve. Cell arrays: `CurveKind` (int:
 * 0 boundary edge, 1 crease, 2 junction, 3 border, 4 corner), `CurveId` (int, -1 at corners), `ChartId` (int, two
 * smooth pieces that meet there, the same twice at a boundary edge, -1 at corners), `EdgeCount` (int: edges of curves
 * that end in a corner, 1 on lines), `Surfaces` (string: names of the surfaces that meet, parted by " + "). Field array
 * `CurveKindName`.
 *
 * Output port 1, Model: triangles with the cell arrays `SurfaceId` and `ChartId` (int: the smooth piece between curves)
 * and the field array `SurfaceName`.
 *
 * Surfaces that cannot be converted, and a domain that cannot be met, are errors; both outputs are empty then.
 */
#ifndef vtkAtriaFeatureGraph_h
#define vtkAtriaFeatureGraph_h

#include "vtkAtriaGridAlgorithm.h"

class ATRIAFILTERSMESHING_EXPORT vtkAtriaFeatureGraph : public vtkAtriaGridAlgorithm
{
public:
  static vtkAtriaFeatureGraph* New();
  vtkTypeMacro(vtkAtriaFeatureGraph, vtkAtriaGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkAtriaFeatureGraph();
  ~vtkAtriaFeatureGraph() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkAtriaFeatureGraph(const vtkAtriaFeatureGraph&) = delete;
  void operator=(const vtkAtriaFeatureGraph&) = delete;
};

#endif
