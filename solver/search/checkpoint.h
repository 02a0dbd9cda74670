// SPDX-License-Identifier: Apache-2.0
// The state of a search as bytes that outlive the process: what was found, and what is still open. Binary
// (CBOR, RFC 8949), so that every double is kept exactly; with a mark of the problem and a checksum.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "solver/search/search_options.h"
#include "solver/search/system.h"

namespace hcsp {

/// The FNV-1a hash of a run of bytes, to be gone on with.
std::uint64_t hash_of(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325U);

/// What a state of one search has in common with no other problem's or goal's: a hash of the relations, the
/// domains and the precision.
std::uint64_t mark_of(const System& system, std::string_view goal, const SearchOptions& options);
/// The same of relations between unknowns that are no System.
std::uint64_t mark_of(const Dag& dag, const std::vector<NodeId>& stated,
                      const std::vector<System::Unknown>& unknowns, std::string_view goal,
                      const SearchOptions& options);

std::string sealed(const nlohmann::json& state, std::uint64_t mark);
/// What was sealed. std::invalid_argument where the bytes are damaged, or have another mark.
nlohmann::json opened(const std::string& bytes, std::uint64_t mark);

nlohmann::json json_of(const std::vector<Interval>& box);
std::vector<Interval> box_of(const nlohmann::json& bounds);

}  // namespace hcsp
