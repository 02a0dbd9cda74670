// SPDX-License-Identifier: Apache-2.0
// Names and types: after a check without a diagnostic every name of the model stands for something, every
// expression has its type, and constants that sizes and indices need have been evaluated.
#pragma once

#include <map>
#include <string>

#include "lang/model/model.h"

namespace hcsp::lang {

/// Reads the data files (relative to the source that names them) and checks every item.
/// `data_files` replaces files by the name of their data, relative to the working folder.
void check(Model& model, const std::map<std::string, std::string>& data_files);

}  // namespace hcsp::lang
