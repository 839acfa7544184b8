// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string_view>

namespace msc_vo {

// The files of web/, embedded when the library is built (cmake/MscVoEmbed.cmake).

extern const std::string_view kReportStyle;   ///< CSS of the static page
extern const std::string_view kViewerStyle;   ///< CSS of the interactive part
extern const std::string_view kViewerHtml;    ///< its elements
extern const std::string_view kViewerScript;  ///< its JavaScript, for one function scope
extern const std::string_view kThreeLicense;
extern const std::string_view kThreeScript;  ///< three.js; empty if it was not found at build time

}  // namespace msc_vo
