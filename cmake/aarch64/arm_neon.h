// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Precedes the compiler's header of this name, for Eigen, which fuses multiplication and addition if
// the compiler says that the processor can (MscVoTargets.cmake).

#pragma once

#include_next <arm_neon.h>
#undef __ARM_FEATURE_FMA
