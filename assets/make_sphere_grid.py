#!/usr/bin/env python3
"""Writes sphere_grid.glb: spheres of roughness 0 to 1 (columns) and metallic 0, 0.5 and 1 (rows)."""
import json
import math
import struct
import sys

COLUMNS, ROWS, AROUND, DOWN = 6, 3, 48, 24

points, indices = [], []
for j in range(DOWN + 1):
    for i in range(AROUND + 1):
        theta, phi = math.pi * j / DOWN, 2 * math.pi * i / AROUND
        points += [math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi)]
for j in range(DOWN):
    for i in range(AROUND):
        a, b = j * (AROUND + 1) + i, (j + 1) * (AROUND + 1) + i
        if j > 0:
            indices += [a, b, a + 1]
        if j < DOWN - 1:
            indices += [a + 1, b, b + 1]

vertices = struct.pack("<%df" % len(points), *points)
faces = struct.pack("<%dH" % len(indices), *indices)
materials, meshes, nodes = [], [], []
for row in range(ROWS):
    for column in range(COLUMNS):
        metallic, roughness = row / (ROWS - 1), column / (COLUMNS - 1)
        color = [1.0, 0.77, 0.34, 1.0] if row > 0 else [0.6, 0.05, 0.05, 1.0]
        materials.append({"name": "metallic %g roughness %g" % (metallic, roughness),
                          "pbrMetallicRoughness": {"baseColorFactor": color,
                                                   "metallicFactor": metallic,
                                                   "roughnessFactor": roughness}})
        meshes.append({"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1,
                                       "material": len(materials) - 1}]})
        nodes.append({"mesh": len(meshes) - 1,
                      "translation": [2.4 * (column - (COLUMNS - 1) / 2), 2.4 * (1 - row), 0]})
nodes.append({"camera": 0, "translation": [0, 0, 22]})
scene = {
    "asset": {"version": "2.0", "generator": "assets/make_sphere_grid.py"},
    "scene": 0,
    "scenes": [{"nodes": list(range(len(nodes)))}],
    "nodes": nodes,
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.44, "znear": 1, "zfar": 100}}],
    "materials": materials,
    "meshes": meshes,
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": len(points) // 3, "type": "VEC3",
         "min": [-1, -1, -1], "max": [1, 1, 1]},
        {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}],
    "bufferViews": [
        {"buffer": 0, "byteLength": len(vertices), "target": 34962},
        {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(faces), "target": 34963}],
    "buffers": [{"byteLength": len(vertices) + len(faces)}],
}
text = json.dumps(scene, separators=(",", ":")).encode()
text += b" " * (-len(text) % 4)
binary = vertices + faces
binary += b"\0" * (-len(binary) % 4)
with open(sys.argv[1] if len(sys.argv) > 1 else "sphere_grid.glb", "wb") as out:
    out.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary)))
    out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
    out.write(struct.pack("<II", len(binary), 0x004E4942) + binary)
