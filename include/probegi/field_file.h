#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "probegi/backend.h"
#include "probegi/export.h"
#include "probegi/field.h"
#include "probegi/image.h"
#include "probegi/result.h"
#include "probegi/scene.h"
#include "probegi/snapshot.h"
#include "probegi/tracer.h"

/// Fields in files: docs/field_file.md has the format, byte by byte.
namespace probegi {

/// Two numbers by which a field's scene is known again; 0: unknown.
struct SceneFingerprint {
    std::uint64_t geometry = 0;  ///< of the triangles, and of what lets rays through: what masks depend on
    std::uint64_t light = 0;     ///< of punctual lights, the sky, and what surfaces reflect and emit as probes see them

    bool operator==(const SceneFingerprint&) const = default;
};

/// Of a scene at a moment; the names of things and the cameras are not in it. Errors: unsupported (built without file
/// formats).
PROBEGI_API Result<SceneFingerprint> fingerprintOf(const Scene& scene, const ScenePose& pose, const Lighting& lighting);

/// Where a field comes from. Nothing of it changes its light.
struct FieldProvenance {
    std::string program{};  ///< that made it, with its version
    std::string scene{};    ///< as the program was told
    std::string recipe{};   ///< how it was made: the program's options, say
    SceneFingerprint fingerprint{};
};

/// What a file holds.
struct SavedField {
    FieldSnapshot snapshot{};  ///< of all probes, and what the field is made of
    /// Masks included, whose report has no times. Primitives are not kept: LeakGuard::sdfShadow comes back as moments.
    FieldSettings settings{};
    FieldProvenance provenance{};  ///< all empty: not known
    ConvergeState convergence{};   ///< empty, or of a Field::converge that is still under way
};

/// Writes a field as writeFile() does: whole or not at all. Errors: invalidArgument (a snapshot that is not whole, or
/// that validation refuses; masks of other volumes; a text of provenance over 64 KiB), outOfMemory, writeFailed,
/// unsupported (built without file formats); of a field on a GPU also deviceLost.
PROBEGI_API Result<void> saveField(const std::filesystem::path& path, const SavedField& saved);
PROBEGI_API Result<void> saveField(const std::filesystem::path& path, const Field& field,
                                   const FieldProvenance& provenance = {});

/// Reads a field; all values have passed the checks of Field::create and Field::write. Errors: fileNotFound,
/// fileUnreadable, malformed (no field, cut off, damaged), unsupported (of a later version, or with a part that this
/// version must not skip), outOfMemory (out of proportion to its size, see ReadLimits).
PROBEGI_API Result<SavedField> loadField(const std::filesystem::path& path, const ReadLimits& limits = {});

/// Whether a file begins as saveField's do. False where it cannot be read.
PROBEGI_API bool isFieldFile(const std::filesystem::path& path) noexcept;

/// A field that goes on as the saved one would have, to the bit, on the same backend. Errors: those of
/// Backend::makeField and Field::write.
PROBEGI_API Result<Field> restoreField(const Backend& backend, const SavedField& saved);

}  // namespace probegi
