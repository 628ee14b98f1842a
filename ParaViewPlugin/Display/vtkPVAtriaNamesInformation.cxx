// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkPVAtriaNamesInformation.h"

#include "VtkSurface.h"

#include <vtkAlgorithm.h>
#include <vtkCellData.h>
#include <vtkClientServerStream.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkMultiProcessStream.h>
#include <vtkObjectFactory.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <iterator>

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

std::set<int> indicesIn(vtkDataObject* data, const char* name)
{
  std::set<int> indices;
  for (vtkDataSet* part : vtkCompositeDataSet::GetDataSets(data))
  {
    vtkDataArray* array = part->GetCellData()->GetArray(name);
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      indices.insert(static_cast<int>(array->GetComponent(i, 0)));
    }
  }
  return indices;
}

} // namespace

vtkPVAtriaNamesInformation::vtkPVAtriaNamesInformation() { this->SetRootOnly(1); }

vtkPVAtriaNamesInformation::~vtkPVAtriaNamesInformation() = default;

std::string vtkPVAtriaNamesInformation::GetName(int i)
{
  return i >= 0 && i < this->GetNumberOfNames() ? this->Names[i] : std::string();
}

int vtkPVAtriaNamesInformation::GetIndex(int i)
{
  return i >= 0 && i < this->GetNumberOfIndices() ? *std::next(this->Indices.begin(), i) : -1;
}

void vtkPVAtriaNamesInformation::CopyFromObject(vtkObject* object)
{
  this->Names.clear();
  this->Indices.clear();
  auto* algorithm = vtkAlgorithm::SafeDownCast(object);
  vtkDataObject* data = algorithm && this->PortNumber < algorithm->GetNumberOfOutputPorts()
                            ? algorithm->GetOutputDataObject(this->PortNumber)
                            : nullptr;
  if (data)
  {
    this->Names = this->ArrayName == "SurfaceName" ? atria::surfaceNamesFromVtk(data)
                                                   : fieldStrings(data, this->ArrayName.c_str());
    if (!this->IndexArrayName.empty())
    {
      this->Indices = indicesIn(data, this->IndexArrayName.c_str());
    }
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
    this->Indices.insert(names->Indices.begin(), names->Indices.end());
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
  *stream << this->GetNumberOfIndices();
  for (const int index : this->Indices)
  {
    *stream << index;
  }
  *stream << vtkClientServerStream::End;
}

void vtkPVAtriaNamesInformation::CopyFromStream(const vtkClientServerStream* stream)
{
  this->Names.clear();
  this->Indices.clear();
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
  int indices = 0;
  stream->GetArgument(0, count + 1, &indices);
  for (int i = 0; i < indices; ++i)
  {
    int index = 0;
    stream->GetArgument(0, count + 2 + i, &index);
    this->Indices.insert(index);
  }
}

void vtkPVAtriaNamesInformation::CopyParametersToStream(vtkMultiProcessStream& stream)
{
  stream << this->PortNumber << this->ArrayName << this->IndexArrayName;
}

void vtkPVAtriaNamesInformation::CopyParametersFromStream(vtkMultiProcessStream& stream)
{
  stream >> this->PortNumber >> this->ArrayName >> this->IndexArrayName;
}

void vtkPVAtriaNamesInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PortNumber: " << this->PortNumber << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "IndexArrayName: " << this->IndexArrayName << "\n";
  os << indent << "NumberOfNames: " << this->Names.size() << "\n";
  os << indent << "NumberOfIndices: " << this->Indices.size() << "\n";
}
