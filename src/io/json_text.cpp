#include "io/json_text.h"

namespace probegi::io {

namespace {

using nlohmann::json;

/// Parses the text without building anything.
class Weigher final : public nlohmann::json_sax<json> {
public:
    Weigher(Budget& budget, std::string_view kind) : m_budget(budget), m_kind(kind) {}

    bool isObject() const { return m_isObject; }
    bool tooDeep() const { return m_tooDeep; }

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t& text) override { return value(text.size()); }
    bool binary(binary_t&) override { return value(); }
    bool key(string_t& text) override { return value(text.size()); }
    bool start_object(std::size_t) override {
        if (m_depth == 0) m_isObject = true;
        return begin(kObjectBytes);
    }
    bool start_array(std::size_t) override { return begin(kArrayBytes); }
    bool end_object() override { return end(); }
    bool end_array() override { return end(); }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& fault) override {
        constexpr int kNumberTooLarge = 406;
        if (fault.id == kNumberTooLarge)
            refuseMalformed("its JSON has a number at byte {} that is too large", position);
        refuseMalformed("is not {}: its JSON is invalid or cut off at byte {}", m_kind, position);
    }

private:
    // Measured on nodes: two JSON trees, tinygltf's node and ours.
    static constexpr std::uint64_t kObjectBytes = 512;
    static constexpr std::uint64_t kArrayBytes = 96;
    static constexpr std::uint64_t kValueBytes = 32;
    static constexpr int kMaxDepth = 65;  // real files are about 10 deep, 100,000 would overflow the stack

    bool value(std::size_t text = 0) {
        m_budget.charge(kValueBytes + text);
        return true;
    }
    bool begin(std::uint64_t bytes) {
        m_budget.charge(bytes);
        m_tooDeep |= ++m_depth > kMaxDepth;
        return true;
    }
    bool end() {
        --m_depth;
        return true;
    }

    Budget& m_budget;
    std::string_view m_kind;
    int m_depth = 0;
    bool m_isObject = false;
    bool m_tooDeep = false;
};

}  // namespace

json parseJsonText(std::span<const std::uint8_t> text, Budget& budget, std::string_view kind) {
    Weigher weigher(budget, kind);
    json::sax_parse(text.begin(), text.end(), &weigher);
    if (!weigher.isObject()) refuseMalformed("its JSON is not an object");
    if (weigher.tooDeep()) refuseMalformed("its JSON is nested too deeply, over 64 levels");
    return json::parse(text.begin(), text.end());
}

}  // namespace probegi::io
