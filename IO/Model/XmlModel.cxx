// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelFile.h"
#include "XmlSizes.h"

#include "Support/Error.h"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkExecutive.h>
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
#include <initializer_list>
#include <regex>

namespace atria::model {

namespace {

/// Keeps errors and warnings of VTK's objects, which would go to the console.
class Messages : public vtkCommand
{
public:
  vtkTypeMacro(Messages, vtkCommand);
  static Messages* New() { return new Messages; }

  void Execute(vtkObject*, unsigned long event, void* text) override
  {
    // "ERROR: In file.cxx, line 1\nvtkClass (0x1): text\n\n"
    static const std::regex place(R"(^(ERROR|Warning): In [^\n]*\n[^\n]*?\([^)\n]*\): )");
    std::string message = std::regex_replace(static_cast<const char*>(text), place, "");
    message.erase(message.find_last_not_of(" \n\r") + 1);
    if (event == vtkCommand::WarningEvent)
    {
      warnings.push_back(message);
    }
    else if (firstError.empty())
    {
      firstError = message;
    }
  }

  std::string firstError;
  std::vector<std::string> warnings;
};

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

/// Throws Error if the arrays of cells contradict themselves.
void checkCells(vtkDataObject* object, const std::string& file)
{
  if (auto* data = vtkPolyData::SafeDownCast(object))
  {
    for (vtkCellArray* cells : {data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips()})
    {
      if (!cells->IsValid())
      {
        throw Error("'" + file +
                    "' cannot be read as a VTK XML file: its cells begin and end at places that cannot be; " +
                    "write it again");
      }
    }
  }
  else if (auto* tree = vtkDataObjectTree::SafeDownCast(object))
  {
    vtkSmartPointer<vtkDataObjectTreeIterator> it;
    it.TakeReference(tree->NewTreeIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      checkCells(it->GetCurrentDataObject(), file);
    }
  }
}

} // namespace

Model readXml(const std::string& file)
{
  checkXmlSizes(file);
  const vtkSmartPointer<vtkXMLReader> reader = readerFor(file);
  vtkNew<Messages> messages;
  for (vtkObject* watched : std::initializer_list<vtkObject*>{reader, reader->GetExecutive()})
  {
    watched->AddObserver(vtkCommand::ErrorEvent, messages);
    watched->AddObserver(vtkCommand::WarningEvent, messages);
  }
  reader->SetParserErrorObserver(messages);
  if (!reader->CanReadFile(file.c_str()))
  {
    throw Error("'" + file + "' does not hold the VTK XML data that its ending says; write it again");
  }
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkDataObject* output = reader->GetOutputDataObject(0);
  if (!messages->firstError.empty() || !output)
  {
    throw Error("'" + file + "' cannot be read as a VTK XML file" +
                (messages->firstError.empty() ? "" : ": " + messages->firstError) + "; write it again");
  }
  checkCells(output, file);
  Model model;
  model.warnings = messages->warnings;
  model.data = output;
  if (auto* data = vtkPolyData::SafeDownCast(output))
  {
    keepPartsOf(data, model);
    // A block of the file's name gives a name to polydata without any.
    vtkNew<vtkMultiBlockDataSet> block;
    block->SetBlock(0, data);
    block->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), stemOf(file));
    model.data = block;
  }
  return model;
}

} // namespace atria::model
