// The library _exr.so.
#include "exr_part.h"

#include "majorant/pictures/images/internal/exr_file.h"

extern "C" __attribute__((visibility("default")))
const majorant::python::ExrPart majorant_part{&majorant::decode_exr, &majorant::encode_exr};

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
