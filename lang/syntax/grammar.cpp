// SPDX-License-Identifier: Apache-2.0
// The grammar of docs/language.md, in Spirit X3 over tokens. Rules carry pointers into the tree; the actions
// build it.
// `>` marks the point from which only one continuation is possible: a failure behind it is a syntax error
// there.
#include "lang/syntax/grammar.h"

#include <boost/spirit/home/x3.hpp>

#include "lang/syntax/operators.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace x3 = boost::spirit::x3;

namespace {

// What the actions need beside their attributes.
struct State {
  SyntaxTree& tree;
  std::uint32_t nesting = 0;
  std::optional<SyntaxError> error;
};
struct StateTag {};

template <class Context>
State& state(const Context& context) {
  return x3::get<StateTag>(context).get();
}

// NOLINTBEGIN(readability-identifier-naming): Spirit's names, and rules that are called as in
// docs/language.md.

// One token of a kind. It has no attribute: actions look back at the token.
struct TokenParser : x3::parser<TokenParser> {
  using attribute_type = x3::unused_type;
  static constexpr bool has_attribute = false;
  TokenKind kind;
  explicit TokenParser(TokenKind k) : kind(k) {}

  template <class Iterator, class Context, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context&, x3::unused_type, Attribute&) const {
    if (first == last || first->kind != kind) return false;
    ++first;
    return true;
  }
};
TokenParser token(TokenKind kind) { return TokenParser(kind); }

// Counts how deep the subject nests: text must not be able to exhaust the stack.
template <class Subject>
struct NestedParser : x3::unary_parser<Subject, NestedParser<Subject>> {
  using Base = x3::unary_parser<Subject, NestedParser<Subject>>;
  static constexpr bool is_pass_through_unary = true;
  explicit NestedParser(const Subject& subject) : Base(subject) {}

  template <class Iterator, class Context, class Attribute>
  bool parse(Iterator& first, const Iterator& last, const Context& context, x3::unused_type,
             Attribute& attr) const {
    struct Depth {
      std::uint32_t& nesting;
      explicit Depth(std::uint32_t& n) : nesting(n) { ++nesting; }
      Depth(const Depth&) = delete;
      Depth& operator=(const Depth&) = delete;
      ~Depth() { --nesting; }
    } depth(state(context).nesting);
    if (depth.nesting > kDeepestNesting) {
      state(context).error = SyntaxError{SyntaxError::Kind::too_deep, first, {}};
      boost::throw_exception(x3::expectation_failure<Iterator>(first, "less nesting"));
    }
    return this->subject.parse(first, last, context, x3::unused, attr);
  }
};
template <class Subject>
NestedParser<typename x3::extension::as_parser<Subject>::value_type> nested(const Subject& subject) {
  return NestedParser<typename x3::extension::as_parser<Subject>::value_type>(x3::as_parser(subject));
}

}  // namespace
}  // namespace hcsp::lang

// How an expectation failure names what it wanted: a rule by its name, a token by its kind, and what is made
// of them by what comes first.
namespace boost::spirit::x3 {
template <>
struct get_info<hcsp::lang::TokenParser> {
  using result_type = std::string;
  std::string operator()(const hcsp::lang::TokenParser& parser) const {
    return hcsp::lang::describe(parser.kind);
  }
};
template <class Subject, class Action>
struct get_info<action<Subject, Action>> {
  using result_type = std::string;
  std::string operator()(const action<Subject, Action>& parser) const { return what(parser.subject); }
};
template <class Left, class Right>
struct get_info<sequence<Left, Right>> {
  using result_type = std::string;
  std::string operator()(const sequence<Left, Right>& parser) const { return what(parser.left); }
};
template <class Left, class Right>
struct get_info<list<Left, Right>> {
  using result_type = std::string;
  std::string operator()(const list<Left, Right>& parser) const { return what(parser.left); }
};
template <class Left, class Right>
struct get_info<alternative<Left, Right>> {
  using result_type = std::string;
  std::string operator()(const alternative<Left, Right>& parser) const {
    return what(parser.left) + " or " + what(parser.right);
  }
};
}  // namespace boost::spirit::x3

namespace hcsp::lang {
namespace {

using enum TokenKind;
using x3::_attr;
using x3::_val;

// ---- Actions.

template <class Context>
const Token* here(const Context& context) {
  return x3::_where(context).begin();
}
template <class Context>
const Token& last_token(const Context& context) {
  return *(here(context) - 1);
}

// Stores the attribute in a member of the rule's value.
template <class Struct, class Member>
auto put(Member Struct::*member) {
  return [member](auto& ctx) { _val(ctx).*member = _attr(ctx); };
}
template <class Struct, class Member>
auto append(std::vector<Member> Struct::*member) {
  return [member](auto& ctx) { (_val(ctx).*member).push_back(_attr(ctx)); };
}

// A node from a rule's first token (or the operand that it extends) to the last token read.
template <class Context>
Expr* finish(Context& ctx, Expr expr, const SourceRange& first) {
  expr.range = first.to((here(ctx) - 1)->range);
  State& s = state(ctx);
  Expr* made = s.tree.make(std::move(expr));
  if (made->depth > kDeepestTree) {
    s.error = SyntaxError{SyntaxError::Kind::too_deep, here(ctx) - 1, {}};
    boost::throw_exception(x3::expectation_failure<const Token*>(here(ctx) - 1, "less nesting"));
  }
  return made;
}

// A node under construction, with its first token.
struct Draft {
  Expr expr;
  SourceRange first;
};

template <class Context>
void begin_draft(Context& ctx, ExprKind kind) {
  _val(ctx).expr.kind = kind;
  _val(ctx).first = here(ctx)->range;
}
auto begins(ExprKind kind) {
  return x3::eps[([kind](auto& ctx) { begin_draft(ctx, kind); })];
}
const auto add_operand = [](auto& ctx) { _val(ctx).expr.operands.push_back(_attr(ctx)); };
const auto add_binding = [](auto& ctx) { _val(ctx).expr.bindings.push_back(_attr(ctx)); };
auto quantifier(TokenKind kind, Quantifier which) {
  return token(kind)[([which](auto& ctx) { _val(ctx).expr.quantifier = which; })];
}

// ---- Rules. Their names are what "expected ..." says.

const x3::rule<class ExpressionRule, Expr*> expression = "an expression";
const x3::rule<class ChainRule, std::vector<ChainLink>> chain = "an expression";
const x3::rule<class LinkRule, ChainLink> link = "an expression";
const x3::rule<class OperandRule, Expr*> operand = "an expression";
const x3::rule<class BodyRule, Expr*> body = "a body in parentheses or braces";
const x3::rule<class MemberRule, Draft> member = "`.`";
const x3::rule<class IndexRule, Draft> index = "`[`";
const x3::rule<class CallRule, Draft> call = "`(`";
const x3::rule<class TupleRule, Draft> tuple = "`(`";
const x3::rule<class IntervalRule, Draft> interval = "`[`";
const x3::rule<class BuilderRule, Draft> builder = "`{`";
const x3::rule<class ForallRule, Draft> forall = "`forall`";
const x3::rule<class ReductionRule, Draft> reduction = "a quantifier";
const x3::rule<class ConditionalRule, Draft> conditional = "`if`";
const x3::rule<class PointRule, Binding> point = "a name";
const x3::rule<class BoundNameRule, Binding> bound_name = "a name";
const x3::rule<class NameRule, Name> name = "a name";
const x3::rule<class PathRule, Name> path = "a file name in quotes";
const x3::rule<class TypeRule, TypeExpr*> type = "a type";
const x3::rule<class TypeDraftRule, TypeExpr> type_draft = "a type";

std::string_view unquoted(std::string_view text) {
  return text.substr(1, std::max<std::size_t>(text.size(), 2) - 2);
}

const auto name_def = token(identifier)[([](auto& ctx) {
  _val(ctx) = Name{last_token(ctx).text(), last_token(ctx).range};
})];
const auto path_def = token(string)[([](auto& ctx) {
  _val(ctx) = Name{unquoted(last_token(ctx).text()), last_token(ctx).range};
})];

// ---- Types.

auto base(TokenKind kind, TypeExpr::Base which) {
  return token(kind)[([which](auto& ctx) { _val(ctx).base = which; })];
}
const auto array_of = token(kw_array) > token(left_bracket) >
                      (expression[append(&TypeExpr::arrays)] % token(comma)) > token(right_bracket) >
                      token(kw_of);
const auto lifted = token(kw_tube)[([](auto& ctx) { _val(ctx).tube = true; })] |
                    token(kw_set)[([](auto& ctx) { _val(ctx).set = true; })];
const auto sizes = token(left_bracket) > (expression[append(&TypeExpr::sizes)] % token(comma)) >
                   token(right_bracket);
const auto type_draft_def = x3::eps[([](auto& ctx) { _val(ctx).range = here(ctx)->range; })] >> *array_of >>
                            -lifted >>
                            (base(kw_real, TypeExpr::Base::real) | base(kw_int, TypeExpr::Base::integer) |
                             base(kw_bool, TypeExpr::Base::boolean)) >>
                            -sizes;
const auto type_def = type_draft[([](auto& ctx) {
  TypeExpr& made = _attr(ctx);
  made.range = made.range.to((here(ctx) - 1)->range);
  _val(ctx) = state(ctx).tree.make(std::move(made));
})];

// ---- Expressions: operands between operators; operators.cpp knows which binds tighter.

const auto expression_def = nested(chain)[([](auto& ctx) {
  std::optional<SyntaxError> error;
  Expr* built = build_chain(_attr(ctx), state(ctx).tree, error);
  if (built == nullptr) {
    state(ctx).error = error;
    boost::throw_exception(x3::expectation_failure<const Token*>(here(ctx), "an expression"));
  }
  _val(ctx) = built;
})];

const auto set_operator = [](auto& ctx) { _val(ctx).back().op = here(ctx) - 1; };
// Operators of several levels make a long chain and no deep tree; a longer one fills the memory.
constexpr std::size_t kLongestChain = 100 * kDeepestTree;
const auto add_link = [](auto& ctx) {
  _val(ctx).push_back(std::move(_attr(ctx)));
  if (_val(ctx).size() <= kLongestChain) return;
  state(ctx).error = SyntaxError{SyntaxError::Kind::too_deep, here(ctx) - 1, {}};
  boost::throw_exception(x3::expectation_failure<const Token*>(here(ctx), "an expression"));
};
const auto binary_operator = token(plus) | token(minus) | token(star) | token(slash) | token(caret) |
                             token(equal) | token(less) | token(less_equal) | token(greater) |
                             token(greater_equal) | token(not_equal) | token(plus_minus) | token(range) |
                             token(kw_and) | token(kw_or) | token(kw_xor) | token(kw_implies) |
                             token(kw_iff) | token(kw_in) | token(kw_subset) | token(kw_union) |
                             token(kw_inter) | token(kw_symdiff) | token(backslash);
const auto chain_def = link[add_link] >> *(binary_operator[set_operator] > link[add_link]);

const auto prefix =
    (token(minus) | token(kw_not))[([](auto& ctx) { _val(ctx).prefixes.push_back(here(ctx) - 1); })];
const auto link_def = (+prefix > operand[put(&ChainLink::operand)]) | operand[put(&ChainLink::operand)];

auto leaf(ExprKind kind) {
  return [kind](auto& ctx) {
    Expr expr;
    expr.kind = kind;
    const Token& token = last_token(ctx);
    expr.text = kind == ExprKind::string ? unquoted(token.text()) : token.text();
    expr.token = token.range;
    _val(ctx) = finish(ctx, std::move(expr), token.range);
  };
}
const auto node = [](auto& ctx) { _val(ctx) = finish(ctx, std::move(_attr(ctx).expr), _attr(ctx).first); };
// (a) is a.
const auto tuple_or_operand = [](auto& ctx) {
  Draft& draft = _attr(ctx);
  if (!draft.expr.bindings.empty()) draft.expr.kind = ExprKind::comprehension;
  const bool is_more = draft.expr.operands.size() > 1 || !draft.expr.bindings.empty();
  _val(ctx) = is_more ? finish(ctx, std::move(draft.expr), draft.first) : draft.expr.operands.front();
};
const auto extend = [](auto& ctx) {
  Draft& draft = _attr(ctx);
  draft.expr.operands.insert(draft.expr.operands.begin(), _val(ctx));
  _val(ctx) = finish(ctx, std::move(draft.expr), _val(ctx)->range);
};
// sum(x), min(a, b): the words of quantifiers are functions too.
const auto function_word = token(kw_sum) | token(kw_prod) | token(kw_min) | token(kw_max) | token(kw_subset);

const auto primary = token(identifier)[leaf(ExprKind::name)] | token(number)[leaf(ExprKind::number)] |
                     tuple[tuple_or_operand] | reduction[node] | function_word[leaf(ExprKind::name)] |
                     interval[node] | builder[node] | forall[node] | conditional[node] |
                     token(string)[leaf(ExprKind::string)] | token(kw_oo)[leaf(ExprKind::infinity)] |
                     token(kw_true)[leaf(ExprKind::boolean)] | token(kw_false)[leaf(ExprKind::boolean)];

// atleast(k, i in 1..n) c reads as a call until its body follows.
bool is_count(const Expr& call) {
  if (call.kind != ExprKind::call || call.operands.size() != 3) return false;
  const Expr &callee = *call.operands[0], &bound = *call.operands[2];
  return callee.kind == ExprKind::name && callee.text == "atleast" && bound.kind == ExprKind::binary &&
         bound.op == Operator::in && bound.operands[0]->kind == ExprKind::name &&
         bound.operands[1]->kind == ExprKind::binary && bound.operands[1]->op == Operator::range;
}
const auto counts = x3::eps[([](auto& ctx) { x3::_pass(ctx) = is_count(*_val(ctx)); })];
const auto count_body = [](auto& ctx) {
  const Expr& call = *_val(ctx);
  const Expr& bound = *call.operands[2];
  Expr expr;
  expr.kind = ExprKind::quantified;
  expr.quantifier = Quantifier::at_least;
  expr.token = call.operands[0]->range;
  expr.bindings.push_back({{bound.operands[0]->text, bound.operands[0]->range}, nullptr, bound.operands[1]});
  expr.operands = {_attr(ctx), call.operands[1]};
  _val(ctx) = finish(ctx, std::move(expr), call.range);
};
const auto operand_def = primary >> *(call[extend] | index[extend] | member[extend]) >>
                         -(counts > expression[count_body]);

const auto set_member = [](auto& ctx) {
  const Token& named = last_token(ctx);
  _val(ctx).expr.text = named.kind == string ? unquoted(named.text()) : named.text();
  _val(ctx).expr.token = named.range;
};
const x3::rule<class ColumnRule> column = "a column name";
const auto column_def = token(identifier) | token(string);
const auto member_def = begins(ExprKind::member) >> token(dot) > column[set_member];
const auto index_def = begins(ExprKind::index) >> token(left_bracket) >
                       (expression[add_operand] % token(comma)) > token(right_bracket);
const auto call_def = begins(ExprKind::call) >> token(left_paren) >
                      -(expression[add_operand] % token(comma)) > token(right_paren);

const auto tuple_def = begins(ExprKind::tuple) >> token(left_paren) > expression[add_operand] >
                       ((token(bar) > (bound_name[add_binding] % token(comma))) |
                        *(token(comma) > expression[add_operand])) > token(right_paren);
const auto interval_def = begins(ExprKind::interval) >> token(left_bracket) > expression[add_operand] >
                          token(comma) > expression[add_operand] > token(right_bracket);
const auto point_def = name[put(&Binding::name)] >> -(token(colon) > type[put(&Binding::type)]);
const auto builder_def = begins(ExprKind::builder) >> token(left_brace) > point[add_binding] >
                         token(bar) > expression[add_operand] > token(right_brace);
const auto bound_name_def = name[put(&Binding::name)] >> -(token(kw_in) > expression[put(&Binding::domain)]);
const auto bound_names = token(left_paren) > (bound_name[add_binding] % token(comma)) > token(right_paren);
const auto forall_def = begins(ExprKind::quantified) >> (quantifier(kw_forall, Quantifier::forall) |
                                                         quantifier(kw_exists, Quantifier::exists)) >>
                        bound_names > expression[add_operand];
const auto reduction_word = quantifier(kw_sum, Quantifier::sum) | quantifier(kw_prod, Quantifier::product) |
                            quantifier(kw_min, Quantifier::minimum) | quantifier(kw_max, Quantifier::maximum);
const auto set_word =
    quantifier(kw_union, Quantifier::set_union) | quantifier(kw_inter, Quantifier::set_inter);
const auto binds = &(token(left_paren) >> token(identifier) >> token(kw_in));
const auto reduction_def = begins(ExprKind::quantified) >>
                           ((reduction_word >> binds) | set_word) >> bound_names > body[add_operand];
const auto body_def =
    (token(left_paren) > expression[([](auto& ctx) { _val(ctx) = _attr(ctx); })] > token(right_paren)) |
    builder[node];
const auto conditional_def = begins(ExprKind::conditional) >> token(kw_if) > expression[add_operand] >
                             token(kw_then) > expression[add_operand] >
                             token(kw_else) > expression[add_operand] > token(kw_endif);

BOOST_SPIRIT_DEFINE(expression, chain, link, operand, body, member, index, call, tuple, interval, builder,
                    forall, reduction, conditional, point, bound_name, name, path, type, type_draft, column)

// ---- Items.

const x3::rule<class ItemRule, Item> item = "an item";
const x3::rule<class ModelRule, ModelItem> model_item = "`model`";
const x3::rule<class IncludeRule, IncludeItem> include_item = "`include`";
const x3::rule<class ParamRule, ParamItem> param_item = "`param`";
const x3::rule<class DataRule, DataItem> data_item = "`data`";
const x3::rule<class TimeRule, TimeItem> time_item = "`time`";
const x3::rule<class ParameterRule, Parameter> parameter = "a parameter `name : type`";
const x3::rule<class LocalRule, Local> local = "a local `name = value`";
const x3::rule<class FunctionRule, FunctionItem> function_item = "`function`";
const x3::rule<class GivenRule, GivenItem> given_item = "`given`";
const x3::rule<class VarRule, VarItem> var_item = "`var`";
const x3::rule<class LetRule, LetItem> let_item = "`let`";
const x3::rule<class ConstraintRule, ConstraintItem> constraint_item = "`constraint`, `implied` or `family`";
const x3::rule<class SolveRule, SolveItem> solve_item = "`solve`";
const x3::rule<class ShowRule, ShowItem> show_item = "`show`";

const auto model_item_def = token(kw_model) > name[put(&ModelItem::name)];
const auto include_item_def = token(kw_include) > path[put(&IncludeItem::path)];
const auto param_item_def = token(kw_param) > name[put(&ParamItem::name)] >
                            -(token(colon) > type[put(&ParamItem::type)]) >
                            token(assign) > expression[put(&ParamItem::value)];
const auto data_item_def = token(kw_data) > name[put(&DataItem::name)] >
                           token(assign) > name[put(&DataItem::reader)] >
                           token(left_paren) > path[put(&DataItem::path)] > token(right_paren);
const auto span = token(kw_in) > expression[put(&TimeItem::span)] >
                  ((token(kw_phases) > expression[put(&TimeItem::phases)]) |
                   (token(kw_step) > expression[put(&TimeItem::step)]));
const auto stamps = token(kw_at) > expression[put(&TimeItem::stamps)];
const auto time_item_def = token(kw_time) > name[put(&TimeItem::name)] > (stamps | span);

const auto parameter_def = name[put(&Parameter::name)] > token(colon) > type[put(&Parameter::type)];
const auto local_def = name[put(&Local::name)] > token(assign) > expression[put(&Local::value)];
const auto function_item_def = token(kw_function) > name[put(&FunctionItem::name)] > token(left_paren) >
                               -(parameter[append(&FunctionItem::parameters)] % token(comma)) >
                               token(right_paren) > token(colon) > type[put(&FunctionItem::type)] >
                               token(assign) > expression[put(&FunctionItem::body)] >
                               -(token(kw_where) > (local[append(&FunctionItem::locals)] % token(comma)));
const auto given_item_def = token(kw_given) > name[put(&GivenItem::name)] >
                            token(colon) > type[put(&GivenItem::type)] >
                            token(assign) > expression[put(&GivenItem::value)];
const auto var_item_def = token(kw_var) > (name[append(&VarItem::names)] % token(comma)) >
                          token(colon) > type[put(&VarItem::type)] >
                          -(token(kw_in) > expression[put(&VarItem::domain)]) >
                          -(token(kw_precision) > expression[put(&VarItem::precision)]);
const auto let_item_def = token(kw_let) > name[put(&LetItem::name)] >
                          -(token(colon) > type[put(&LetItem::type)]) >
                          token(assign) > expression[put(&LetItem::value)];
const auto constraint_word = token(kw_constraint) |
                             token(kw_implied)[([](auto& ctx) { _val(ctx).is_implied = true; })] |
                             token(kw_family)[([](auto& ctx) { _val(ctx).is_of_family = true; })];
const auto constraint_item_def = constraint_word >
                                 -(&(token(identifier) >> token(colon)) >> name[put(&ConstraintItem::name)] >>
                                   token(colon)) > expression[put(&ConstraintItem::relation)];

auto goal(TokenKind kind, SolveItem::Goal which) {
  return token(kind)[([which](auto& ctx) { _val(ctx).goal = which; })];
}
const auto solve_item_def =
    token(kw_solve) >
    (goal(kw_propagate, SolveItem::Goal::propagate) | goal(kw_all, SolveItem::Goal::all) |
     (goal(kw_pave, SolveItem::Goal::pave) > token(left_paren) >
      (expression[append(&SolveItem::arguments)] % token(comma)) > token(right_paren)) |
     (goal(kw_minimize, SolveItem::Goal::minimize) > expression[append(&SolveItem::arguments)]) |
     (goal(kw_maximize, SolveItem::Goal::maximize) > expression[append(&SolveItem::arguments)])) >
    -(token(kw_precision) > expression[put(&SolveItem::precision)]);
const auto show_item_def = token(kw_show) > (expression[append(&ShowItem::shown)] % token(comma));

const auto store = [](auto& ctx) { _val(ctx).content = std::move(_attr(ctx)); };
const auto item_def = (constraint_item[store] | var_item[store] | param_item[store] | given_item[store] |
                       let_item[store] | function_item[store] | data_item[store] | time_item[store] |
                       show_item[store] | solve_item[store] | model_item[store] | include_item[store]) >
                      token(semicolon);

BOOST_SPIRIT_DEFINE(item, model_item, include_item, param_item, data_item, time_item, parameter, local,
                    function_item, given_item, var_item, let_item, constraint_item, solve_item, show_item)

// NOLINTEND(readability-identifier-naming)

template <class Rule, class Attribute>
std::optional<SyntaxError> read(const Rule& rule, const Token*& at, const Token* end, SyntaxTree& tree,
                                Attribute& attribute) {
  State state{tree, 0, {}};
  try {
    const auto grammar = x3::with<StateTag>(std::ref(state))[rule];
    if (x3::parse(at, end, grammar, attribute)) return {};
    return SyntaxError{SyntaxError::Kind::expected, at, x3::what(rule)};
  } catch (const x3::expectation_failure<const Token*>& failure) {
    if (state.error) return state.error;
    return SyntaxError{SyntaxError::Kind::expected, failure.where(), failure.which()};
  }
}

}  // namespace

std::optional<SyntaxError> read_item(const Token*& at, const Token* end, SyntaxTree& tree, Item& result) {
  return read(item, at, end, tree, result);
}

std::optional<SyntaxError> read_expression(const Token*& at, const Token* end, SyntaxTree& tree,
                                           Expr*& result) {
  return read(expression, at, end, tree, result);
}

}  // namespace hcsp::lang
