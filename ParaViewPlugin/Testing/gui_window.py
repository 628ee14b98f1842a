# SPDX-License-Identifier: GPL-3.0-or-later
"""ParaView's window as a user sees it, for scripts that run in the client (paraview --script)."""

import os
import pathlib
import sys
import time
import traceback

from PyQt5 import QtCore, QtWidgets

OUTPUT = pathlib.Path(os.environ["ATRIA_OUTPUT"])


class Window:
    """The main window: what is clicked, typed and looked at."""

    def __init__(self, folder):
        self.app = QtWidgets.QApplication.instance()
        self.main = next(w for w in self.app.topLevelWidgets() if w.objectName() == "pqClientMainWindow")
        self.folder = OUTPUT / folder
        self.folder.mkdir(parents=True, exist_ok=True)
        self.main.resize(1280, 900)
        dock = self.main.findChild(QtWidgets.QDockWidget, "propertiesDock")
        self.main.resizeDocks([dock], [400], QtCore.Qt.Horizontal)
        self.main.resizeDocks([dock], [600], QtCore.Qt.Vertical)
        self.settle()

    def settle(self, seconds=0.3):
        """Lets the window do what it has put off."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.app.processEvents(QtCore.QEventLoop.AllEvents, 50)

    def find(self, kind, name, within=None):
        """The visible widget of that name."""
        found = [w for w in (within or self.main).findChildren(kind, name) if w.isVisible()]
        assert found, f"the window has no {kind.__name__} {name}"
        return found[0]

    def has(self, kind, name):
        return any(w.isVisible() for w in self.main.findChildren(kind, name))

    def action(self, name, within=None):
        found = (within or self.main).findChildren(QtWidgets.QAction, name)
        assert found, f"there is no action {name}"
        return found[0]

    def trigger(self, name, within=None):
        """Clicks an action, which must be enabled."""
        action = self.action(name, within)
        assert action.isEnabled(), f"{name} cannot be clicked"
        action.trigger()
        self.settle()

    def step(self, name):
        """Clicks a step of Atria's toolbar."""
        self.trigger(name, self.find(QtWidgets.QToolBar, "AtriaSteps"))

    def dock(self):
        return self.find(QtWidgets.QWidget, "propertiesPanel")

    def apply(self):
        button = self.find(QtWidgets.QPushButton, "Accept")
        assert button.isEnabled(), "there is nothing to apply"
        button.click()
        self.settle(1.0)

    def select(self, source, port=0):
        """Makes an output port the active one, as a click in the pipeline browser does."""
        from paraview import simple
        simple.SetActiveSource(simple.OutputPort(source, port) if port else source)
        self.settle()

    def show_advanced(self, shown):
        toggle = self.find(QtWidgets.QToolButton, "AdvancedButton", self.dock())
        if toggle.isChecked() != shown:
            toggle.click()
        self.settle()

    def answer(self, answers, seconds=30):
        """Answers the dialogs to come, {name: function of the dialog}, while what is called next waits for them."""
        pending = dict(answers)
        end = time.monotonic() + seconds

        def look():
            dialog = self.app.activeModalWidget()
            name = dialog.objectName() if dialog else ""
            if name in pending:
                try:
                    pending.pop(name)(dialog)
                except Exception:
                    traceback.print_exc()
                    dialog.reject()
            elif time.monotonic() > end:
                print(f"no dialog of {list(pending)}, but {name!r}", file=sys.stderr)
                if dialog:
                    dialog.reject()
                return
            if pending:
                QtCore.QTimer.singleShot(200, look)

        QtCore.QTimer.singleShot(200, look)

    def look_at(self, point, direction, distance):
        """Turns the camera of the render view as a user would."""
        from paraview import simple
        view = next(v for v in simple.GetViews() if v.GetXMLName() == "RenderView")
        simple.Render(view)  # the first one moves the camera
        view.CameraFocalPoint = point
        view.CameraPosition = [c + distance * d for c, d in zip(point, direction)]
        view.CameraViewUp = [0, 0, 1]
        simple.Render(view)

    def picture(self, name):
        """The whole window."""
        self.settle(0.5)
        file = self.folder / f"{name}.png"
        assert self.main.grab().save(str(file)), file
        return file

    def picture_of(self, widget, name):
        self.settle(0.5)
        file = self.folder / f"{name}.png"
        assert widget.grab().save(str(file)), file
        return file


def choose_file(path, file_type=None):
    """Answers a file dialog."""

    def choose(dialog):
        if file_type:
            types = dialog.findChild(QtWidgets.QComboBox, "EntityType")
            index = next(i for i in range(types.count()) if file_type in types.itemText(i))
            types.setCurrentIndex(index)
        dialog.findChild(QtWidgets.QLineEdit, "EntityName").setText(str(path))
        dialog.findChild(QtWidgets.QPushButton, "OK").click()

    return choose


def choose_reader(text):
    """Answers the question which reader to take."""

    def choose(dialog):
        readers = dialog.findChild(QtWidgets.QListWidget, "listWidget")
        names = [readers.item(i).text() for i in range(readers.count())]
        readers.setCurrentRow(next(i for i, name in enumerate(names) if text in name))
        dialog.findChild(QtWidgets.QPushButton, "okButton").click()

    return choose


def accept(dialog):
    dialog.accept()


def run(session):
    """Runs the session, writes what it prints to the standard output, and ends ParaView with its status."""
    sys.stdout = os.fdopen(os.dup(1), "w", buffering=1)
    sys.stderr = sys.stdout
    status = 1
    try:
        session()
        status = 0
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(status)
