// SPDX-License-Identifier: GPL-3.0-or-later
/// libFuzzer's entry: whatever bytes a VRML file holds, the reader ends without undefined behavior, and either keeps
/// the promises of its output or reports an error and gives none. Run by fuzz.sh.
#include "ReaderFuzzing.h"
#include "vtkAtriaVRMLReader.h"

#include <vtkNew.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const vtkNew<vtkAtriaVRMLReader> reader;
  reader->SetTessellationAngle(45.0);
  atria::fuzzing::readAndJudge(reader, "model.wrl", data, size);
  return 0;
}
