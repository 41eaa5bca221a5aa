// Contact light and that of the picture before.
#include "picture_contact.glsl"

// What the last picture had at a surface, from the four pixels around its place there.
ContactPast pastOf(ContactBlock block, ScreenSample s) {
    ContactPast past = noPast();
    if (block.past.x == 0u && block.past.y == 0u) return past;
    const vec3 pixel = pinholePixel(block.camera, s.position);
    const float width = float(push.width);
    const float height = float(block.rows);
    if (pixel.z <= 0.0 || !(pixel.x >= 0.0 && pixel.x < width && pixel.y >= 0.0 && pixel.y < height)) return past;
    const float left = floor(pixel.x - 0.5);
    const float top = floor(pixel.y - 0.5);
    for (int i = 0; i < 4; ++i) {
        const float x = left + float(i % 2);
        const float y = top + float(i / 2);
        if (x < 0.0 || y < 0.0 || x >= width || y >= height) continue;
        const ContactRecord record = ContactRecords(block.past).at[uint(y) * uint(push.width) + uint(x)];
        const float tent = (1.0 - abs(pixel.x - 0.5 - x)) * (1.0 - abs(pixel.y - 0.5 - y));
        addRecord(
            past, record,
            tent * recordWeight(record, s.position, s.geometricNormal, s.distance, pinholeSpread(push.camera, 1)));
    }
    return past;
}

void main() {
    const uint index = globalIndex();
    if (index >= push.sampleCount) return;
    const ContactBlock block = contactBlock();
    const ScreenSample s = Samples(push.samples).at[index];
    const int x = int(index) % push.width;
    const int y = int(index) / push.width;
    Vec4s blurred = Vec4s(block.blurred);
    const vec4 light = blurred.at[index];
    vec4 lower = light;
    vec4 upper = light;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            if (inFrame(x + i, y + j)) {
                const vec4 near = blurred.at[(y + j) * push.width + x + i];
                lower = min(lower, near);
                upper = max(upper, near);
            }
    float count = 0.0;
    vec4 kept = light;
    if (s.kind == kSampleSurface) kept = keptContact(pastOf(block, s), light, lower, upper, count);
    Vec4s(block.kept).at[index] = kept;
    ContactRecords records = ContactRecords(block.records);
    const uint at = uint(push.firstRow) * uint(push.width) + index;
    if (push.firstPlane == 0) {
        ContactRecord record;
        record.light = kept;
        record.position = s.position;
        record.normal = s.geometricNormal;
        record.count = count;
        records.at[at] = record;
    } else {
        // The mean over planes, of the first one's surface.
        const vec4 mean = records.at[at].light;
        records.at[at].light = mean + (kept - mean) * (1.0 / float(push.firstPlane + 1));
    }
}
