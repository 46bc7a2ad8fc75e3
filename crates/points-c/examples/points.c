/* Prints words for comparison with Rust, and integrates x y over the unit square. */
#include <inttypes.h>
#include <stdio.h>

#include "evenlight_points.h"

int main(void) {
    const uint64_t seed = UINT64_C(0x123456789abcdef);
    for (uint32_t index = 0; index < 8; ++index) {
        for (uint32_t dimension = 0; dimension < EVENLIGHT_SOBOL_DIMS; dimension += 51) {
            printf("%" PRIu32 " %" PRIu32 " %" PRIu32 " %" PRIu32 " %" PRIu32 " %.9g\n", index, dimension,
                   evenlight_sobol(index, dimension), evenlight_owen_sobol(index, dimension, seed),
                   evenlight_shuffled(index, seed), evenlight_unit_f32(evenlight_owen_sobol(index, dimension, seed)));
        }
    }
    const uint32_t count = 1u << 12;
    double sum = 0;
    for (uint32_t index = 0; index < count; ++index) {
        const float x = evenlight_unit_f32(evenlight_owen_sobol(index, 0, seed));
        const float y = evenlight_unit_f32(evenlight_owen_sobol(index, 1, seed));
        sum += (double)x * y;
    }
    printf("mean of x y: %.6f, exactly 0.25\n", sum / count);
    return evenlight_sobol(1, EVENLIGHT_SOBOL_DIMS) == 0 ? 0 : 1;
}
