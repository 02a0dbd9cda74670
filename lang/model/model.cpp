// SPDX-License-Identifier: Apache-2.0
#include "lang/model/model.h"

namespace hcsp::lang {

const Expr& Model::unfold(const Expr& expr) const {
  const Expr* at = &expr;
  while (at->kind == ExprKind::name) {
    const Symbol* symbol = reference(*at).symbol;
    const LetItem* let = symbol == nullptr ? nullptr : symbol->as<LetItem>();
    if (let == nullptr) break;
    at = let->value;
  }
  return *at;
}

}  // namespace hcsp::lang
