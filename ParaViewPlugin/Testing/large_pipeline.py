# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a mesh on the ranks of pvbatch; each rank notes a fingerprint of what it holds, and its memory.

Usage: mpiexec -n N pvbatch large_pipeline.py FOLDER MODEL PROPERTIES [case]

PROPERTIES are those of the mesher, as JSON, or for a box about the model `octants`, how many of the finest are along
its longest side. FOLDER gets rank0.json … and time.json, with `case` also case.openfoam, whose processors the ranks
write.
"""

import json
import os
import pathlib
import sys
import time

from paraview import simple

from house_pipeline import load_plugin

HERE = pathlib.Path(__file__).parent

# Runs on each rank.
NOTE = """
import sys
sys.path.insert(0, {here!r})
import pieces
pieces.note({folder!r}, inputs[0].VTKObject, inputs[1].VTKObject)
"""
PEAK = """
import sys
sys.path.insert(0, {here!r})
import pieces
pieces.note_peak({folder!r})
"""


def run_everywhere(inputs, script):
    source = simple.ProgrammableFilter(Input=inputs, OutputDataSetType="vtkTable", CopyArrays=0)
    source.Script = script
    source.UpdatePipeline()


def about(reader, octants):
    """Domain and sizes of a box about a model, a quarter of its longest side larger on all sides."""
    bounds = reader.GetDataInformation().GetBounds()
    longest = max(bounds[i + 1] - bounds[i] for i in (0, 2, 4))
    return {"DomainMode": "Explicit", "DomainBounds": [b + (i % 2 - 0.5) * longest / 2 for i, b in enumerate(bounds)],
            "SizeMin": longest / octants, "SizeMid": 2 * longest / octants, "SizeMax": 4 * longest / octants}


def main(folder, model, properties, *rest):
    load_plugin()
    reader = simple.OpenDataFile(model)
    reader.UpdatePipeline()
    given = json.loads(properties)
    if "octants" in given:
        given |= about(reader, given.pop("octants"))
    mesher = simple.AtriaDualMesher(Input=reader, CacheStages=0, **given)
    wall, processor = time.time(), time.process_time()
    mesher.UpdatePipeline()
    seconds = {"wall": time.time() - wall, "processor": time.process_time() - processor}
    outputs = [simple.OutputPort(mesher, 0), simple.OutputPort(mesher, 1)]
    where = {"folder": folder, "here": str(HERE)}
    run_everywhere(outputs, NOTE.format(**where))
    if "case" in rest:
        simple.SaveData(os.path.join(folder, "case.openfoam"), proxy=mesher, UseRanksAsProcessors=1,
                        WriteWholeMesh=0)
        run_everywhere(outputs, PEAK.format(**where))
    (pathlib.Path(folder) / "time.json").write_text(json.dumps(seconds))


main(*sys.argv[1:])
