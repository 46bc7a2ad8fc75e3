/* evenlight_points.h: points of the unit cube as pure functions of (index, dimension, seed).
 *
 * Nothing to initialize, to allocate or to free; every function may be called from any thread. Words have their first
 * digit in their most significant bit; evenlight_unit_f32 makes them numbers in [0, 1), never 1. The same arguments
 * give the same bits as in Rust (evenlight_points::stateless) and in Python (evenlight.points.Sobol), on every machine.
 *
 * Build with `cargo build --release -p evenlight-points-c`, then for instance
 *     cc -I crates/points-c/include main.c target/release/libevenlight_points_c.a -lpthread -ldl -lm
 */
#ifndef EVENLIGHT_POINTS_H
#define EVENLIGHT_POINTS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Dimensions are 0 to EVENLIGHT_SOBOL_DIMS - 1; any other gives the word 0. */
#define EVENLIGHT_SOBOL_DIMS 256

/* A coordinate of a Sobol' point with the direction numbers of Joe and Kuo (2008), not randomized. */
uint32_t evenlight_sobol(uint32_t index, uint32_t dimension);

/* A coordinate of an Owen-scrambled Sobol' point (Owen 1995, hashed as in Burley 2020). Each seed is an independent
 * randomization; any number will do. Average over 2^k indices from 0 on. */
uint32_t evenlight_owen_sobol(uint32_t index, uint32_t dimension, uint64_t seed);

/* The index in a random order that keeps nets nets: for taking the same dimensions again (padding, Burley 2020). */
uint32_t evenlight_shuffled(uint32_t index, uint64_t seed);

/* The upper 24 bits of a word as a number in [0, 1). */
float evenlight_unit_f32(uint32_t word);

#ifdef __cplusplus
}
#endif

#endif
