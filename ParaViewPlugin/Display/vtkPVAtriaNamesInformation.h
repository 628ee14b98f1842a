// SPDX-License-Identifier: GPL-3.0-or-later
/// Information object that brings names from the server to ParaView's client.
/**
 * @class   vtkPVAtriaNamesInformation
 * @brief   brings names from the data of an output port, wherever the server is, to the client
 *
 * With ArrayName `SurfaceName`, returns the names of surfaces as the filters find them: in a field array, in a cell
 * array, or in names of blocks. Any other ArrayName is a field array of strings.
 */
#ifndef vtkPVAtriaNamesInformation_h
#define vtkPVAtriaNamesInformation_h

#include "AtriaParaViewDisplayModule.h" // For export macro
#include "vtkPVInformation.h"

#include <set>    // for Indices
#include <string> // for names
#include <vector> // for Names

class vtkMultiProcessStream;

class ATRIAPARAVIEWDISPLAY_EXPORT vtkPVAtriaNamesInformation : public vtkPVInformation
{
public:
  static vtkPVAtriaNamesInformation* New();
  vtkTypeMacro(vtkPVAtriaNamesInformation, vtkPVInformation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Output port of the algorithm. Default 0.
   */
  vtkSetMacro(PortNumber, int);
  vtkGetMacro(PortNumber, int);
  ///@}

  ///@{
  /**
   * Array the names are in. Default "SurfaceName".
   */
  vtkSetMacro(ArrayName, std::string);
  vtkGetMacro(ArrayName, std::string);
  ///@}

  ///@{
  /**
   * Cell array of integers, indices into the names; those that occur are gathered as well. Empty by default: none are.
   */
  vtkSetMacro(IndexArrayName, std::string);
  vtkGetMacro(IndexArrayName, std::string);
  ///@}

  ///@{
  /**
   * Gathered names and indices; empty before, and if there is no data or array.
   */
  int GetNumberOfNames() { return static_cast<int>(this->Names.size()); }
  std::string GetName(int i);
  int GetNumberOfIndices() { return static_cast<int>(this->Indices.size()); }
  int GetIndex(int i);
  ///@}

  void CopyFromObject(vtkObject* algorithm) override;
  void AddInformation(vtkPVInformation* other) override;
  void CopyToStream(vtkClientServerStream* stream) override;
  void CopyFromStream(const vtkClientServerStream* stream) override;
  void CopyParametersToStream(vtkMultiProcessStream& stream) override;
  void CopyParametersFromStream(vtkMultiProcessStream& stream) override;

protected:
  vtkPVAtriaNamesInformation();
  ~vtkPVAtriaNamesInformation() override;

private:
  vtkPVAtriaNamesInformation(const vtkPVAtriaNamesInformation&) = delete;
  void operator=(const vtkPVAtriaNamesInformation&) = delete;

  int PortNumber = 0;
  std::string ArrayName = "SurfaceName";
  std::string IndexArrayName;
  std::vector<std::string> Names;
  std::set<int> Indices;
};

#endif
