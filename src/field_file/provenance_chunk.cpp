#include "field_file/field_chunks.h"

namespace probegi {

void writeProvenance(ChunkWriter& file, const FieldProvenance& provenance) {
    const auto& [program, scene, recipe, fingerprint] = provenance;
    ByteWriter bytes;
    bytes.put(fingerprint.geometry);
    bytes.put(fingerprint.light);
    for (const std::string* text : {&program, &scene, &recipe}) bytes.put(std::string_view(*text));
    file.add(kProvenanceChunk, ChunkNeed::optional, bytes.bytes());
}

FieldProvenance readProvenance(const ChunkReader& file) {
    FieldProvenance provenance;
    if (!file.has(kProvenanceChunk)) return provenance;
    const std::vector<std::byte> content = file.content(kProvenanceChunk);
    ByteReader bytes(content, "texts");
    provenance.fingerprint.geometry = bytes.take<std::uint64_t>();
    provenance.fingerprint.light = bytes.take<std::uint64_t>();
    for (std::string* text : {&provenance.program, &provenance.scene, &provenance.recipe})
        *text = bytes.take<std::string>();
    bytes.finish();
    return provenance;
}

}  // namespace probegi
