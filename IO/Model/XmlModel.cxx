// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelFile.h"

#include "Support/Error.h"

#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>

namespace atria::model {

namespace {

void keepPartsOf(vtkPolyData* data, Model& model)
{
  auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SurfaceName"));
  auto* materials = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("MaterialName"));
  for (vtkIdType i = 0; names && materials && i < std::min(names->GetNumberOfValues(), materials->GetNumberOfValues());
       ++i)
  {
    model.parts[names->GetValue(i)] = {names->GetValue(i), materials->GetValue(i), static_cast<std::size_t>(i)};
  }
}

vtkSmartPointer<vtkXMLReader> readerFor(const std::string& file)
{
  const std::string ending = lowerEnding(file);
  if (ending == ".vtp")
  {
    return vtkSmartPointer<vtkXMLPolyDataReader>::New();
  }
  if (ending == ".vtm")
  {
    return vtkSmartPointer<vtkXMLMultiBlockDataReader>::New();
  }
  return vtkSmartPointer<vtkXMLPartitionedDataSetCollectionReader>::New();
}

} // namespace

Model readXml(const std::string& file)
{
  readBytes(file);
  const vtkSmartPointer<vtkXMLReader> reader = readerFor(file);
  const Messages messages(reader);
  if (!reader->CanReadFile(file.c_str()))
  {
    throw Error("'" + file + "' does not hold the VTK XML data that its ending says; write it again");
  }
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkDataObject* output = reader->GetOutputDataObject(0);
  if (!messages.error().empty() || !output)
  {
    throw Error("'" + file + "' cannot be read as a VTK XML file" +
                (messages.error().empty() ? "" : ": " + messages.error()) + "; write it again");
  }
  Model model;
  model.warnings = messages.warnings();
  model.data = output;
  if (auto* data = vtkPolyData::SafeDownCast(output))
  {
    keepPartsOf(data, model);
    // A name for polydata without any, as a block of that name.
    vtkNew<vtkMultiBlockDataSet> block;
    block->SetBlock(0, data);
    block->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), stemOf(file));
    model.data = block;
  }
  return model;
}

} // namespace atria::model
