"""Writes meshes as Wavefront OBJ text, byte for byte the same every time."""

import os

HEADER = ("# %s\n# Katagami sample model; "
          "made by samples/make-samples.py, do not edit\n")


def write(folder, name, title, mesh, digits, colours):
    """Write NAME.obj, and NAME.mtl when the faces have materials."""
    materials = sorted({l.material for l in mesh.labels if l.material})
    if materials:
        put(folder, name + ".mtl", material_text(title, materials, colours))
    put(folder, name + ".obj",
        object_text(title, mesh, digits, name if materials else None))


def put(folder, file_name, text):
    # Binary, so that no platform turns the line ends into its own.
    with open(os.path.join(folder, file_name), "wb") as out:
        out.write(text.encode("ascii"))


def material_text(title, materials, colours):
    lines = [HEADER % title]
    for material in materials:
        lines.append("newmtl %s\nKd %.3f %.3f %.3f\n"
                     % ((material,) + colours[material]))
    return "".join(lines)


def object_text(title, mesh, digits, library):
    lines = [HEADER % title]
    if library:
        lines.append("mtllib %s.mtl\n" % library)
    for p in mesh.points:
        lines.append("v %s\n" % " ".join(number(c, digits) for c in p))
    lines.extend(face_lines(mesh))
    for row in mesh.lines:
        lines.append("l %s\n" % " ".join(str(i + 1) for i in row))
    return "".join(lines)


def face_lines(mesh):
    """Faces in their order, each new name announced where it begins."""
    object_name = group = material = None
    for face, label in zip(mesh.faces, mesh.labels):
        if label.object != object_name:
            object_name = label.object
            yield "o %s\n" % object_name
        if label.group != group:
            group = label.group
            yield "g %s\n" % (group or "default")
        if label.material != material:
            material = label.material
            yield "usemtl %s\n" % material
        yield "f %s\n" % " ".join(str(i + 1) for i in face)


def number(value, digits):
    text = "%.*f" % (digits, value)
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text
