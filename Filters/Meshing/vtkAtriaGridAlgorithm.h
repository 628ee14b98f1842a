// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaGridAlgorithm
 * @brief   sizes, domain and features, common to the feature graph, the octree source and the dual mesher
 *
 * Lengths are in the model's units; defaults suit a building in metres. Input port 0 takes the surface model: a
 * vtkPolyData, or a composite of named vtkPolyData blocks. A vtkPolyData names its surfaces by the cell array
 * `SurfaceId` and the field array `SurfaceName`, as vtkAtriaVRMLReader writes them.
 */
#ifndef vtkAtriaGridAlgorithm_h
#define vtkAtriaGridAlgorithm_h

#include "AtriaFiltersMeshingModule.h"
#include "vtkAlgorithm.h"

#include <string> // for SiteName

class ATRIAFILTERSMESHING_EXPORT vtkAtriaGridAlgorithm : public vtkAlgorithm
{
public:
  vtkTypeMacro(vtkAtriaGridAlgorithm, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Edge length of the largest octants, those in the open. The level whose octants come closest to it is taken.
   * Default 8; clamped to at least 1e-9.
   */
  vtkSetClampMacro(SizeMax, double, 1e-9, VTK_DOUBLE_MAX);
  vtkGetMacro(SizeMax, double);
  ///@}

  ///@{
  /**
   * Edge length of octants that a surface passes through. Default 2; clamped to at least 1e-9.
   */
  vtkSetClampMacro(SizeMid, double, 1e-9, VTK_DOUBLE_MAX);
  vtkGetMacro(SizeMid, double);
  ///@}

  ///@{
  /**
   * Edge length of the finest octants, those with a feature curve, a corner, or surfaces that do not meet inside
   * them. Default 1; clamped to at least 1e-9.
   */
  vtkSetClampMacro(SizeMin, double, 1e-9, VTK_DOUBLE_MAX);
  vtkGetMacro(SizeMin, double);
  ///@}

  ///@{
  /**
   * Level to which every octant of the domain is refined at least; the root cube is level 0. Default 4; clamped to [0,
   * 20].
   */
  vtkSetClampMacro(StartLevel, int, 0, 20);
  vtkGetMacro(StartLevel, int);
  ///@}

  ///@{
  /**
   * Degrees between the normals of two triangles above which their edge is a crease, and between two pieces of a curve
   * above which their point is a corner. Default 30; clamped to [0, 180].
   */
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  /**
   * Where the domain box comes from.
   */
  enum DomainModes
  {
    FromSurfaces = 0, ///< the bounds of the surfaces
    Explicit = 1,     ///< DomainBounds
    Site = 2          ///< above the surface SiteName: its bounds, and 0.3 times its longer side above its highest point
  };

  ///@{
  /**
   * Where the domain box comes from. Default FromSurfaces.
   */
  vtkSetClampMacro(DomainMode, int, FromSurfaces, Site);
  vtkGetMacro(DomainMode, int);
  ///@}

  ///@{
  /**
   * xMin, xMax, yMin, yMax, zMin, zMax of the domain if DomainMode is Explicit. Default: the cube of 100 about the
   * origin in x and y, from 0 to 50 in z.
   */
  vtkSetVector6Macro(DomainBounds, double);
  vtkGetVector6Macro(DomainBounds, double);
  ///@}

  ///@{
  /**
   * Name of the surface that is the site, if DomainMode is Site. Default "Site".
   */
  vtkSetMacro(SiteName, std::string);
  vtkGetMacro(SiteName, std::string);
  ///@}

  ///@{
  /**
   * Sets the data of an input port, without a pipeline before it.
   */
  void SetInputData(vtkDataObject* data);
  void SetInputData(int port, vtkDataObject* data);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
  vtkAtriaGridAlgorithm();
  ~vtkAtriaGridAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  virtual int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) { return 1; }
  virtual int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) = 0;

  double SizeMax = 8.0;
  double SizeMid = 2.0;
  double SizeMin = 1.0;
  int StartLevel = 4;
  double FeatureAngle = 30.0;
  int DomainMode = FromSurfaces;
  double DomainBounds[6] = {-50.0, 50.0, -50.0, 50.0, 0.0, 50.0};
  std::string SiteName = "Site";

private:
  vtkAtriaGridAlgorithm(const vtkAtriaGridAlgorithm&) = delete;
  void operator=(const vtkAtriaGridAlgorithm&) = delete;
};

#endif
