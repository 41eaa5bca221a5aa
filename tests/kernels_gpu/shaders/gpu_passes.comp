#include "lane.h"

#include "kernels/abi/gpu_passes.h"

// Structs only: that both languages know them by the same members.
void evaluate(INOUT(Lane) lane) {
    QueryPush query;
    query.queries = uvec2(takeBits(lane), 1u);
    query.count = 3u;
    giveBits(lane, query.queries.x + query.count);
    giveBits(lane, uint(kPictureDiffuseOnly));
}
