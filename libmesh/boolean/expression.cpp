#include <treeform/mesh/boolean.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform {
namespace {

constexpr auto add = boolean_expression::add;
constexpr auto intersect = boolean_expression::intersect;
constexpr auto minus = boolean_expression::minus;
constexpr auto exclude = boolean_expression::exclude;
constexpr std::int32_t bracket = -5;  // only while reading

std::int32_t operation_of(char c) {
    switch (c) {
        case '+':
        case '|':
            return add;
        case '*':
        case '&':
            return intersect;
        case '-':
            return minus;
        case '^':
            return exclude;
        default:
            return 0;
    }
}

bool apply(std::int32_t operation, bool left, bool right) {
    switch (operation) {
        case add:
            return left || right;
        case intersect:
            return left && right;
        case minus:
            return left && !right;
        default:
            return left != right;
    }
}

/// 0 ... 25, or 26 for what is no letter.
std::size_t letter_of(char c) {
    if (c >= 'a' && c <= 'z') return static_cast<std::size_t>(c - 'a');
    if (c >= 'A' && c <= 'Z') return static_cast<std::size_t>(c - 'A');
    return 26;
}

bool is_in_name(char c) {
    return letter_of(c) < 26 || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
           static_cast<unsigned char>(c) >= 128;
}

/// Operators wait until one that binds no tighter, or a bracket, follows their right side.
class reader {
  public:
    reader(std::string_view text, std::size_t operand_count)
        : text_(text), operand_count_(operand_count) {}
    /// Of names: all of `names`, or those that come up, which are added to them.
    reader(std::string_view text, std::vector<std::string>& names, bool may_add)
        : text_(text), names_(&names), may_add_(may_add) {}

    std::vector<std::int32_t> read() {
        for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
            if (operand_next_)
                read_operand();
            else
                read_operator();
        }
        if (operand_next_) refuse(at_, "an operand is missing");
        while (!waiting_.empty()) {
            if (waiting_.back().operation == bracket)
                refuse(waiting_.back().at, "this bracket is not closed");
            emit_waiting();
        }
        return std::move(postfix_);
    }

  private:
    struct waiting {
        std::int32_t operation;
        std::size_t at;
    };

    [[noreturn]] void refuse(std::size_t at, const std::string& why) const {
        throw std::invalid_argument("treeform::boolean_expression: position " +
                                    std::to_string(at + 1) + " of \"" + std::string(text_) +
                                    "\": " + why);
    }

    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    }

    void emit_waiting() {
        postfix_.push_back(waiting_.back().operation);
        waiting_.pop_back();
    }

    void read_operand() {
        if (text_[at_] == '(') {
            waiting_.push_back({bracket, at_++});
            return;
        }
        postfix_.push_back(static_cast<std::int32_t>(names_ ? named_operand() : operand()));
        operand_next_ = false;
    }

    std::size_t operand() {
        const std::size_t begin = at_;
        std::size_t number = 0;  // 1 is a, 27 is aa
        for (; at_ < text_.size() && letter_of(text_[at_]) < 26; ++at_)
            if (number <= operand_count_) number = number * 26 + letter_of(text_[at_]) + 1;
        if (number == 0) refuse(begin, "expected an operand or a bracket");
        if (number > operand_count_)
            refuse(begin, "there " +
                              (operand_count_ == 1
                                   ? std::string("is 1 operand")
                                   : "are " + std::to_string(operand_count_) + " operands") +
                              " only");
        return number - 1;
    }

    std::size_t named_operand() {
        const std::size_t begin = at_;
        std::string_view name;
        if (const char quote = text_[at_]; quote == '\'' || quote == '"') {
            const std::size_t end = text_.find(quote, at_ + 1);
            if (end == std::string_view::npos) refuse(begin, "this quote is not closed");
            name = text_.substr(begin + 1, end - begin - 1);
            at_ = end + 1;
        } else {
            while (at_ < text_.size() && is_in_name(text_[at_])) ++at_;
            name = text_.substr(begin, at_ - begin);
            if (name.empty()) refuse(begin, "expected an operand or a bracket");
        }
        const auto found = std::ranges::find(*names_, name);
        const auto number = static_cast<std::size_t>(found - names_->begin());
        if (found != names_->end()) return number;
        if (!may_add_) refuse(begin, "no operand is named " + std::string(name) + list_of_names());
        names_->emplace_back(name);
        return number;
    }

    /// "; the names are body, bolt_1"
    [[nodiscard]] std::string list_of_names() const {
        constexpr std::size_t most = 10;
        std::string list;
        for (std::size_t i = 0; i < std::min(most, names_->size()); ++i)
            list += (i == 0 ? "; the names are " : ", ") + (*names_)[i];
        return names_->size() > most ? list + ", ..." : list;
    }

    void read_operator() {
        if (text_[at_] == ')') {
            while (!waiting_.empty() && waiting_.back().operation != bracket) emit_waiting();
            if (waiting_.empty()) refuse(at_, "this bracket was not opened");
            waiting_.pop_back();
            ++at_;
            return;
        }
        const std::int32_t operation = operation_of(text_[at_]);
        if (operation == 0) refuse(at_, "expected one of + | * & - ^ )");
        while (!waiting_.empty() && waiting_.back().operation != bracket &&
               (operation != intersect || waiting_.back().operation == intersect))
            emit_waiting();
        waiting_.push_back({operation, at_++});
        operand_next_ = true;
    }

    std::string_view text_;
    std::size_t operand_count_ = 0;
    std::vector<std::string>* names_ = nullptr;
    bool may_add_ = false;
    std::size_t at_ = 0;
    bool operand_next_ = true;
    std::vector<waiting> waiting_{};
    std::vector<std::int32_t> postfix_{};
};

/// What can be said of a value before all operands are known.
struct outlook {
    bool may_be_false = true;
    bool may_be_true = true;
};

outlook apply(std::int32_t operation, const outlook& left, const outlook& right) {
    outlook result{false, false};
    for (const bool l : {false, true})
        for (const bool r : {false, true}) {
            if (!(l ? left.may_be_true : left.may_be_false) ||
                !(r ? right.may_be_true : right.may_be_false))
                continue;
            (apply(operation, l, r) ? result.may_be_true : result.may_be_false) = true;
        }
    return result;
}

}  // namespace

boolean_expression::boolean_expression(std::string_view text, std::size_t operand_count)
    : operand_count_(operand_count), postfix_(reader(text, operand_count).read()) {}

boolean_expression::boolean_expression(std::string_view text, std::span<const std::string> names)
    : operand_count_(names.size()) {
    std::vector<std::string> known(names.begin(), names.end());
    postfix_ = reader(text, known, false).read();
}

std::vector<std::string> boolean_expression::names_in(std::string_view text) {
    std::vector<std::string> names;
    static_cast<void>(reader(text, names, true).read());
    return names;
}

boolean_expression::boolean_expression(std::size_t operand_count, std::int32_t operation)
    : operand_count_(operand_count) {
    if (operand_count > std::size_t{std::numeric_limits<std::int32_t>::max()})
        throw std::invalid_argument("treeform::boolean_expression: more than 2^31 - 1 operands");
    for (std::size_t i = 0; i < operand_count; ++i) {
        postfix_.push_back(static_cast<std::int32_t>(i));
        if (i > 0) postfix_.push_back(operation);
    }
}

boolean_expression boolean_expression::union_of(std::size_t operand_count) {
    return {operand_count, add};
}

boolean_expression boolean_expression::intersection_of(std::size_t operand_count) {
    return {operand_count, intersect};
}

boolean_expression boolean_expression::difference_of(std::size_t operand_count) {
    return {operand_count, minus};
}

boolean_expression boolean_expression::symmetric_difference_of(std::size_t operand_count) {
    return {operand_count, exclude};
}

bool boolean_expression::operator()(std::span<const bool> in_operand) const {
    std::vector<bool> values;
    for (const std::int32_t token : postfix_) {
        if (token >= 0) {
            values.push_back(in_operand[static_cast<std::size_t>(token)]);
            continue;
        }
        const bool right = values.back();
        values.pop_back();
        values.back() = apply(token, values.back(), right);
    }
    return !values.empty() && values.back();
}

bool boolean_expression::is_inside(std::size_t operand) const {
    std::vector<outlook> values;
    for (const std::int32_t token : postfix_) {
        if (token >= 0) {
            values.push_back({true, static_cast<std::size_t>(token) != operand});
            continue;
        }
        const outlook right = values.back();
        values.pop_back();
        values.back() = apply(token, values.back(), right);
    }
    return values.empty() || !values.back().may_be_true;
}

}  // namespace treeform
