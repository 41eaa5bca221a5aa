#pragma once

#include "field_file/chunk_file.h"
#include "probegi/field_file.h"

namespace probegi {

// What each chunk of a field's file holds (docs/field_file.md), to and from its bytes. What throws, throws io::Refused
// and std::bad_alloc.

inline constexpr ChunkName kDescChunk = chunkName("DESC"), kSettingsChunk = chunkName("SETT"),
                           kProbesChunk = chunkName("PROB"), kIrradianceChunk = chunkName("IRRA"),
                           kVisibilityChunk = chunkName("VISI"), kStatesChunk = chunkName("STAT"),
                           kMasksChunk = chunkName("MASK"), kMaskWordsChunk = chunkName("MWRD"),
                           kProvenanceChunk = chunkName("MADE"), kConvergenceChunk = chunkName("CONV");
inline constexpr ChunkName kFieldChunks[] = {kDescChunk,       kSettingsChunk,   kProbesChunk, kIrradianceChunk,
                                             kVisibilityChunk, kStatesChunk,     kMasksChunk,  kMaskWordsChunk,
                                             kProvenanceChunk, kConvergenceChunk};

void writeDesc(ChunkWriter& file, const FieldDesc& desc);
FieldDesc readDesc(const ChunkReader& file);

/// Without the masks.
void writeSettings(ChunkWriter& file, const FieldSettings& settings);
FieldSettings readSettings(const ChunkReader& file);

void writeSnapshot(ChunkWriter& file, const FieldSnapshot& snapshot);
/// The desc must be valid.
FieldSnapshot readSnapshot(const ChunkReader& file, const FieldDesc& desc, io::Budget& budget);

void writeMasks(ChunkWriter& file, const Masks& masks);
/// Null where there are none. Look-ups may use them unchecked.
std::shared_ptr<const Masks> readMasks(const ChunkReader& file);

void writeProvenance(ChunkWriter& file, const FieldProvenance& provenance);
FieldProvenance readProvenance(const ChunkReader& file);

/// Volumes as chunks have them.
void putVolumes(ByteWriter& bytes, const std::vector<VolumeDesc>& volumes);
std::vector<VolumeDesc> takeVolumes(ByteReader& bytes);

/// A bool, or an enumerator below `count`; `what`: for messages.
bool takeFlag(ByteReader& bytes, const char* what);
std::uint32_t takeEnumerator(ByteReader& bytes, std::size_t count, const char* what);

}  // namespace probegi
