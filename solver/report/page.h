// SPDX-License-Identifier: Apache-2.0
// The page of to_html as the build embeds it (page/embed.cmake): the files of page/ and d3 in one text, cut
// where the data go.
#pragma once

#include <string_view>

namespace hcsp::report {

std::string_view page_before_data();
std::string_view page_after_data();

}  // namespace hcsp::report
