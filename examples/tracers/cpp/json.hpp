// A small JSON reader (RFC 8259), for files that are known to be JSON: `raytruth` has checked them.
#pragma once
#include <charconv>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

struct Json {
    enum Kind { Null, Bool, Number, Text, List, Object } kind = Null;
    bool truth = false;
    double number = 0;  // the double nearest to the decimal in the file
    std::string text;
    std::vector<Json> list;
    std::map<std::string, Json> members;

    // Whether the key is stated. A null means the same as a missing key.
    bool has(const std::string& key) const {
        auto found = members.find(key);
        return found != members.end() && found->second.kind != Null;
    }
    const Json& operator[](const std::string& key) const { return members.at(key); }
};

class JsonReader {
public:
    static Json read(const std::string& text) {
        JsonReader reader(text);
        return reader.value();
    }

private:
    const char *at, *end;
    explicit JsonReader(const std::string& text) : at(text.data()), end(text.data() + text.size()) {}

    char peek() {  // the next character that is not blank
        while (at < end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')) ++at;
        if (at == end) throw std::runtime_error("the JSON ends too early");
        return *at;
    }
    bool take(char wanted) {
        if (peek() != wanted) return false;
        ++at;
        return true;
    }
    void expect(char wanted) {
        if (!take(wanted)) throw std::runtime_error(std::string("the JSON lacks a ") + wanted);
    }

    Json value() {
        Json result;
        switch (peek()) {
            case '{':
                result.kind = Json::Object;
                ++at;
                if (take('}')) return result;
                do {
                    peek();
                    std::string key = string();
                    expect(':');
                    result.members[key] = value();
                } while (take(','));
                expect('}');
                return result;
            case '[':
                result.kind = Json::List;
                ++at;
                if (take(']')) return result;
                do result.list.push_back(value());
                while (take(','));
                expect(']');
                return result;
            case '"':
                result.kind = Json::Text;
                result.text = string();
                return result;
            case 't':
            case 'f':
                result.kind = Json::Bool;
                result.truth = *at == 't';
                at += result.truth ? 4 : 5;
                return result;
            case 'n':
                at += 4;
                return result;
            default:
                result.kind = Json::Number;
                auto [stop, error] = std::from_chars(at, end, result.number);
                if (error != std::errc()) throw std::runtime_error("the JSON holds what is no value");
                at = stop;
                return result;
        }
    }

    std::string string() {
        std::string result;
        expect('"');
        for (; at < end && *at != '"'; ++at) {
            if (*at != '\\') {
                result += *at;
                continue;
            }
            switch (*++at) {
                case 'b': result += '\b'; break;
                case 'f': result += '\f'; break;
                case 'n': result += '\n'; break;
                case 'r': result += '\r'; break;
                case 't': result += '\t'; break;
                case 'u': add_utf8(result, code_point()); break;
                default: result += *at;  // \" \\ \/
            }
        }
        expect('"');
        return result;
    }

    unsigned hexadecimal() {  // the four digits behind \u; `at` is left on the last one
        unsigned code = 0;
        std::from_chars(at + 1, at + 5, code, 16);
        at += 4;
        return code;
    }
    unsigned code_point() {
        unsigned code = hexadecimal();
        if (code < 0xD800 || code > 0xDBFF) return code;
        at += 2;  // the second half of a pair follows: \uD83D\uDE00 is one character
        return 0x10000 + ((code - 0xD800) << 10) + (hexadecimal() - 0xDC00);
    }
    static void add_utf8(std::string& text, unsigned code) {
        if (code < 0x80) {
            text += char(code);
            return;
        }
        int tail = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;  // bytes behind the first
        text += char((0xFF00 >> (tail + 1) & 0xFF) | code >> 6 * tail);  // 110…, 1110… or 11110…
        while (tail--) text += char(0x80 | (code >> 6 * tail & 0x3F));
    }
};
