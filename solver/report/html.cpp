// SPDX-License-Identifier: Apache-2.0
#include "solver/report/html.h"

#include "solver/report/page.h"
#include "solver/report/page_data.h"

namespace hcsp {

std::string to_html(const Result& result, const Presentation& presentation) {
  std::string page(report::page_before_data());
  page += report::page_data(result,
                            presentation);  // its strings have no '<', so it cannot end its script element
  page += report::page_after_data();
  return page;
}

}  // namespace hcsp
