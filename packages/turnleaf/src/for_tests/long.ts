/**
 * Samples of tests that take long: `make test` leaves them out, and has of each kind of assertion a
 * shorter one. `make test-long` runs them, those of Rust among them.
 */

/** Whether long samples run, as TURNLEAF_LONG says. */
export const isLong: boolean = Boolean(import.meta.env.TURNLEAF_LONG);
