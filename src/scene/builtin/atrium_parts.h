#pragma once

#include "scene/builtin/mesh_builder.h"

/// Parts of the atrium. Each stands on y = 0, centred on the vertical axis, in metres, and is closed unless stated
/// otherwise.
namespace probegi::builtin {

struct Column {
    float height = 3.25f;  ///< base to top of the abacus
    float radius = 0.26f;  ///< of the shaft at its foot
    int flutes = 20;       ///< grooves around the shaft
    int stepsPerFlute = 5;
};
/// Plinth, torus base, tapering fluted shaft, leafy bell and abacus.
void addColumn(MeshBuilder& out, const Column& column);

/// A row of balusters along X between a plinth and a handrail, `length` metres from end to end.
void addBalustrade(MeshBuilder& out, float length, float height, int balusters);

/// A curtain hanging in folds from its rod at y = 0; a sheet. `gather` 0..1 narrows its middle.
void addCurtain(MeshBuilder& out, float width, float drop, int folds, float gather);
/// A cloth over a rail along X with its top at y = 0: it hangs behind the rail on -Z, and on +Z falls to a ledge 0.97 m
/// below, across it to its edge 0.42 m out, and `drop` metres further; a sheet.
void addThrow(MeshBuilder& out, float width, float drop);

void addPot(MeshBuilder& out, float radius, float height);
/// Arching leaves from the origin; sheets.
void addFronds(MeshBuilder& out, int count, float length, int seed);

/// Round basin with a bowl on a stem; `addWater` fills both.
void addFountain(MeshBuilder& out);
void addWater(MeshBuilder& out);

/// Sixteen-sided urn on a square pedestal.
void addUrn(MeshBuilder& out);

}  // namespace probegi::builtin
