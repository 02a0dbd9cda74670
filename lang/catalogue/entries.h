// SPDX-License-Identifier: Apache-2.0
// The parts of the catalogue, one file a part.
#pragma once

#include <span>

#include "lang/catalogue.h"

namespace hcsp::lang {

std::span<const CatalogueEntry> syntax_entries();
std::span<const CatalogueEntry> name_entries();
std::span<const CatalogueEntry> data_entries();
std::span<const CatalogueEntry> time_entries();
std::span<const CatalogueEntry> relation_entries();

}  // namespace hcsp::lang
