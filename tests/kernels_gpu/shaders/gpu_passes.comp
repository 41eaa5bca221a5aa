#include "lane.h"

#include "kernels/abi/gpu_passes.h"

// Structs only: checks that their members are the same in both languages.
void evaluate(INOUT(Lane) lane) {
    QueryPush query;
    query.queries = uvec2(takeBits(lane), 1u);
    query.count = 3u;
    giveBits(lane, query.queries.x + query.count);
    giveBits(lane, uint(kPictureDiffuseOnly));
}
