"""Writes meshes as Wavefront OBJ text, byte for byte the same every time."""

import os

HEADER = ("# %s\n# Katagami sample model; "
          "made by samples/make-samples.py, do not edit\n")


def write(folder, name, title, mesh, digits, colours):
    """Write NAME.obj, NAME.mtl when the faces have materials, and NAME.png
    when there is a picture."""
    materials = sorted({l.material for l in mesh.labels if l.material})
    if materials:
        put(folder, name + ".mtl",
            material_text(title, materials, colours, name).encode("ascii"))
    if mesh.picture:
        put(folder, name + ".png", mesh.picture.png())
    text = object_text(title, mesh, digits, name if materials else None)
    put(folder, name + ".obj", text.encode("ascii"))


def put(folder, file_name, data):
    # Bytes, so that no platform turns the line ends into its own.
    with open(os.path.join(folder, file_name), "wb") as out:
        out.write(data)


def material_text(title, materials, colours, name):
    lines = [HEADER % title]
    for material in materials:
        lines.append("newmtl %s\nKd %.3f %.3f %.3f\n"
                     % ((material,) + colours[material]))
        if material == "painted":
            lines.append("map_Kd %s.png\n" % name)
    return "".join(lines)


def object_text(title, mesh, digits, library):
    lines = [HEADER % title]
    if library:
        lines.append("mtllib %s.mtl\n" % library)
    for p in mesh.points:
        lines.append("v %s\n" % " ".join(number(c, digits) for c in p))
    places = {}
    for label in mesh.labels:
        for place in label.uv or ():
            places.setdefault(place_text(place), len(places) + 1)
    lines.extend("vt %s\n" % text for text in places)
    lines.extend(face_lines(mesh, places))
    for row in mesh.lines:
        lines.append("l %s\n" % " ".join(str(i + 1) for i in row))
    return "".join(lines)


def place_text(place):
    return " ".join(number(c, 5) for c in place)


def face_lines(mesh, places):
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
        corners = [str(i + 1) for i in face]
        if label.uv:
            corners = ["%s/%d" % (corner, places[place_text(place)])
                       for corner, place in zip(corners, label.uv)]
        yield "f %s\n" % " ".join(corners)


def number(value, digits):
    text = "%.*f" % (digits, value)
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text
