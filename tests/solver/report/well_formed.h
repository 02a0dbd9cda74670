// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/property_tree/xml_parser.hpp>
#include <sstream>
#include <string>

namespace hcsp::sample {

/// What is wrong with an XML text; nothing when it is well-formed.
inline std::string xml_error(const std::string& text) {
  std::istringstream in(text);
  boost::property_tree::ptree tree;
  try {
    boost::property_tree::read_xml(in, tree);
  } catch (const boost::property_tree::xml_parser_error& error) {
    return error.what();
  }
  return {};
}

}  // namespace hcsp::sample
