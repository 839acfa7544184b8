// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

// Marks a function that is compiled twice, with AVX2 and without; the loader selects the version
// for the processor. Both compute the same bits: AVX2 does not contain fused multiplication and
// addition. ThreadSanitizer is not initialised yet when the loader selects.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define MSC_VO_AVX2_IF_PRESENT [[gnu::target_clones("avx2", "default")]]
#else
#define MSC_VO_AVX2_IF_PRESENT
#endif
