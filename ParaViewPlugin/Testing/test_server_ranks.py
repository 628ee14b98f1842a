# SPDX-License-Identifier: GPL-3.0-or-later
"""A pvserver of two ranks makes and draws the mesh that a client shows.

Usage: xvfb-run python3 test_server_ranks.py MPIEXEC PVSERVER PVPYTHON
"""

import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile

RANKS = 2
CLIENT = pathlib.Path(__file__).parent / "ranks_client.py"
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def free_port():
    with socket.socket() as listener:
        listener.bind(("localhost", 0))
        return listener.getsockname()[1]


def wait_for(server, output):
    """Until the first rank listens."""
    for line in iter(output.readline, ""):
        if line.startswith("Accepting connection"):
            return
    raise AssertionError(f"pvserver does not listen; status {server.wait()}")


def main(mpiexec, pvserver, pvpython):
    port = free_port()
    with tempfile.TemporaryFile("w+") as said:
        server = subprocess.Popen([mpiexec, "--oversubscribe", "-n", str(RANKS), pvserver, f"--server-port={port}"],
                                  env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=said, text=True)
        try:
            wait_for(server, server.stdout)
            client = subprocess.run([pvpython, str(CLIENT), str(port)], env=ENVIRONMENT, capture_output=True, text=True,
                                    timeout=240, check=False)
            assert client.returncode == 0, client.stdout + client.stderr
            print(client.stdout)
            server.wait(60)  # it ends as its client goes
            said.seek(0)
            # What its sockets say as the client goes is left out.
            errors = [line for line in said if "ERR|" in line and not re.search("SocketComm|NetworkAccess", line)]
            assert not errors, errors
        finally:
            server.kill()


main(*sys.argv[1:])
