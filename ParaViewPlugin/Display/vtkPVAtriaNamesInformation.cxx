// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkPVAtriaNamesInformation.h"

#include "VtkSurface.h"

#include <vtkAlgorithm.h>
#include <vtkClientServerStream.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkMultiProcessStream.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>

#include <algorithm>

vtkStandardNewMacro(vtkPVAtriaNamesInformation);

namespace {

std::vector<std::string> fieldStrings(vtkDataObject* data, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  std::vector<std::string> strings;
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
  {
    strings.push_back(array->GetValue(i));
  }
  return strings;
}

} // namespace

vtkPVAtriaNamesInformation::vtkPVAtriaNamesInformation() { this->SetRootOnly(1); }

vtkPVAtriaNamesInformation::~vtkPVAtriaNamesInformation() = default;

std::string vtkPVAtriaNamesInformation::GetName(int i)
{
  return i >= 0 && i < this->GetNumberOfNames() ? this->Names[i] : std::string();
}

void vtkPVAtriaNamesInformation::CopyFromObject(vtkObject* object)
{
  this->Names.clear();
  auto* algorithm = vtkAlgorithm::SafeDownCast(object);
  vtkDataObject* data = algorithm && this->PortNumber < algorithm->GetNumberOfOutputPorts()
                            ? algorithm->GetOutputDataObject(this->PortNumber)
                            : nullptr;
  if (data)
  {
    this->Names = this->ArrayName == "SurfaceName" ? atria::surfaceNamesFromVtk(data)
                                                   : fieldStrings(data, this->ArrayName.c_str());
  }
}

void vtkPVAtriaNamesInformation::AddInformation(vtkPVInformation* other)
{
  if (auto* names = vtkPVAtriaNamesInformation::SafeDownCast(other))
  {
    for (const std::string& name : names->Names)
    {
      if (std::find(this->Names.begin(), this->Names.end(), name) == this->Names.end())
      {
        this->Names.push_back(name);
      }
    }
  }
}

void vtkPVAtriaNamesInformation::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply << this->GetNumberOfNames();
  for (const std::string& name : this->Names)
  {
    *stream << name;
  }
  *stream << vtkClientServerStream::End;
}

void vtkPVAtriaNamesInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  this->Names.clear();
  int count = 0;
  if (!stream->GetArgument(0, 0, &count))
  {
    vtkErrorMacro("The server sent no names.");
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    std::string name;
    stream->GetArgument(0, i + 1, &name);
    this->Names.push_back(name);
  }
}

void vtkPVAtriaNamesInformation::CopyParametersToStream(vtkMultiProcessStream& stream)
{
  stream << this->PortNumber << this->ArrayName;
}

void vtkPVAtriaNamesInformation::CopyParametersFromStream(vtkMultiProcessStream& stream)
{
  stream >> this->PortNumber >> this->ArrayName;
}

void vtkPVAtriaNamesInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PortNumber: " << this->PortNumber << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "NumberOfNames: " << this->Names.size() << "\n";
}
