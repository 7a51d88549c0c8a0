import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * A small JSON reader (RFC 8259), for files that are known to be JSON: raytruth has checked them. Objects become Maps,
 * lists Lists, numbers the nearest Doubles, texts Strings; a key whose value is null is left out.
 */
final class Json {
    private final String text;
    private int at = 0;

    private Json(String text) {
        this.text = text;
    }

    static Object read(String text) {
        return new Json(text).value();
    }

    private char peek() { // the next character that is not blank
        while (" \n\r\t".indexOf(text.charAt(at)) >= 0) at++;
        return text.charAt(at);
    }

    private boolean take(char wanted) {
        if (peek() != wanted) return false;
        at++;
        return true;
    }

    private Object value() {
        switch (peek()) {
            case '{': return object();
            case '[': return list();
            case '"': return string();
            case 't': at += 4; return true;
            case 'f': at += 5; return false;
            case 'n': at += 4; return null;
            default:
                int start = at;
                while (at < text.length() && "+-.eE0123456789".indexOf(text.charAt(at)) >= 0) at++;
                return Double.valueOf(text.substring(start, at));
        }
    }

    private Map<String, Object> object() {
        Map<String, Object> members = new HashMap<>();
        at++;
        if (take('}')) return members;
        do {
            peek();
            String key = string();
            take(':');
            Object value = value();
            if (value != null) members.put(key, value);
        } while (take(','));
        take('}');
        return members;
    }

    private List<Object> list() {
        List<Object> items = new ArrayList<>();
        at++;
        if (take(']')) return items;
        do items.add(value());
        while (take(','));
        take(']');
        return items;
    }

    private String string() {
        StringBuilder result = new StringBuilder();
        for (at++; text.charAt(at) != '"'; at++) {
            if (text.charAt(at) != '\\') {
                result.append(text.charAt(at));
                continue;
            }
            char escape = text.charAt(++at);
            if (escape == 'u') {
                result.append((char) Integer.parseInt(text.substring(at + 1, at + 5), 16));
                at += 4;
            } else {
                int place = "bfnrt".indexOf(escape);
                result.append(place < 0 ? escape : "\b\f\n\r\t".charAt(place)); // else one of \" \\ \/
            }
        }
        at++;
        return result.toString();
    }
}
