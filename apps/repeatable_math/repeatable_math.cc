// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Mathematical functions with the same bits on every x86-64 and 64-bit ARM processor.
//
// The C library has several versions of each and chooses among them by the processor: with fused
// multiply-add or without, which differ in the last bit. These definitions call SLEEF's versions
// that are the same everywhere. Those of a program come before those of the C library, also for the
// libraries that it loads. All other arithmetic is that of the compiler, without fused
// multiply-add, or exact.

#include <sleef.h>

// NOLINTBEGIN(readability-identifier-naming): the names of the C library.
extern "C" {

double acos(double x) { return Sleef_cinz_acosd1_u10purec(x); }
double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }
double atan(double x) { return Sleef_cinz_atand1_u10purec(x); }
double atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }
double cos(double x) { return Sleef_cinz_cosd1_u10purec(x); }
double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double log(double x) { return Sleef_cinz_logd1_u10purec(x); }
double pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }
double sin(double x) { return Sleef_cinz_sind1_u10purec(x); }
double tan(double x) { return Sleef_cinz_tand1_u10purec(x); }

void sincos(double x, double* sine, double* cosine) {
  *sine = sin(x);
  *cosine = cos(x);
}

float atan2f(float y, float x) { return static_cast<float>(atan2(y, x)); }
float cosf(float x) { return static_cast<float>(cos(x)); }
float expf(float x) { return static_cast<float>(exp(x)); }
float logf(float x) { return static_cast<float>(log(x)); }
float powf(float x, float y) { return static_cast<float>(pow(x, y)); }
float sinf(float x) { return static_cast<float>(sin(x)); }
float tanf(float x) { return static_cast<float>(tan(x)); }

void sincosf(float x, float* sine, float* cosine) {
  *sine = sinf(x);
  *cosine = cosf(x);
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming)
