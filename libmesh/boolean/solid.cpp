#include <libmesh/base/operand_name.hpp>
#include <libmesh/boolean/check_operand.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/solid.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace treeform {

/// A mesh, or two formulas and what is between them.
struct solid::formula {
    std::shared_ptr<const prepared_mesh> leaf{};
    char operation = 0;
    std::shared_ptr<const formula> left{};
    std::shared_ptr<const formula> right{};
    mutable detail::once evaluated{};
    mutable boolean_result result{};

    formula() = default;
    formula(const formula&) = delete;
    formula& operator=(const formula&) = delete;
    /// One after the other: a sum of a million solids is that deep.
    ~formula() {
        std::vector<std::shared_ptr<const formula>> below;
        const auto take = [&](std::shared_ptr<const formula>& child) {
            if (child && child.use_count() == 1) below.push_back(std::move(child));
        };
        take(left);
        take(right);
        while (!below.empty()) {
            // Nobody else holds it, so that nobody can miss its children.
            auto& last = const_cast<formula&>(*below.back());
            std::shared_ptr<const formula> a = std::move(last.left), b = std::move(last.right);
            below.pop_back();
            take(a);
            take(b);
        }
    }
};

solid::solid(treeform::mesh&& owned)
    : solid(std::make_shared<const prepared_mesh>(std::move(owned))) {}

solid::solid(usable_mesh&& owned) : solid(std::move(owned.mesh)) {}

solid::solid(std::shared_ptr<const prepared_mesh> shared) {
    if (certificate found = detail::boolean::check_operand("solid", shared->indexed_view()); !found)
        throw not_certified_error(std::move(found));
    auto made = std::make_shared<formula>();
    made->leaf = std::move(shared);
    formula_ = std::move(made);
}

solid solid::join(const solid& a, char operation, const solid& b) {
    auto made = std::make_shared<formula>();
    made->operation = operation;
    made->left = a.formula_;
    made->right = b.formula_;
    return solid(std::move(made));
}

solid operator+(const solid& a, const solid& b) { return solid::join(a, '+', b); }
solid operator*(const solid& a, const solid& b) { return solid::join(a, '*', b); }
solid operator-(const solid& a, const solid& b) { return solid::join(a, '-', b); }
solid operator^(const solid& a, const solid& b) { return solid::join(a, '^', b); }

const boolean_result& solid::result() const {
    formula_->evaluated.call([&] {
        std::vector<mesh_ref> operands;
        std::map<const prepared_mesh*, std::size_t> number;
        std::string text;
        // What is still to be written down, the next last: a formula or a character.
        std::vector<std::pair<const formula*, char>> rest{{formula_.get(), 0}};
        while (!rest.empty()) {
            const auto [next, character] = rest.back();
            rest.pop_back();
            if (next == nullptr) {
                text += character;
            } else if (next->leaf) {
                const auto [at, is_new] = number.try_emplace(next->leaf.get(), operands.size());
                if (is_new) operands.emplace_back(*next->leaf);
                text += detail::base::operand_name(at->second);
            } else {
                rest.insert(rest.end(), {{nullptr, ')'},
                                         {next->right.get(), 0},
                                         {nullptr, next->operation},
                                         {next->left.get(), 0},
                                         {nullptr, '('}});
            }
        }
        formula_->result = boolean(operands, boolean_expression(text, operands.size()));
    });
    return formula_->result;
}

const mesh& solid::mesh() const { return result().value(); }

}  // namespace treeform
