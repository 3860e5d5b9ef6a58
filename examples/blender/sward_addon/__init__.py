"""Grows grass on a mesh by the program `sward`: panel Sward in the sidebar of the 3D view. See README.md."""

bl_info = {
    "name": "Sward",
    "description": "Grows grass on a mesh by the program sward",
    "author": "The authors of Sward",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Sward",
    "category": "Object",
}

from . import panel


def register():
    panel.register()


def unregister():
    panel.unregister()
