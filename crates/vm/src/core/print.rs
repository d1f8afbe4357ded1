//! Core form to text, one statement a line. [`super::parse`] reads it.

use super::deep::with_stack;
use super::*;
use std::fmt::Write;

/// The text of a module, without places in the source; `parse(print(m))` has the same meaning as `m`.
pub fn print(module: &Module) -> String {
    with_stack(|| print_here(module)).unwrap_or_else(|_| print_here(module))
}

fn print_here(module: &Module) -> String {
    let mut out = String::from("(module");
    for (i, file) in module.files.iter().enumerate() {
        let _ = write!(out, "\n  (file {i} {})", quoted(file));
    }
    for (i, class) in module.classes.iter().enumerate() {
        let kind = if class.kind == ClassKind::NamedTuple { " namedtuple" } else { "" };
        let fields: Vec<String> = class.fields.iter().map(|f| quoted(f)).collect();
        let _ = write!(out, "\n  (class {i} {} ({}){})", quoted(&class.name), fields.join(" "), kind);
    }
    for (i, value) in &module.constants {
        let _ = write!(out, "\n  (const {i} {})", expr(value));
    }
    for f in &module.functions {
        let _ = write!(out, "\n  (fn {} (file {}) (params{})", quoted(&f.name), f.file, vars(&f.params));
        if !f.defaults.is_empty() {
            let _ = write!(out, " (defaults{})", tail(&f.defaults));
        }
        if !f.captures.is_empty() {
            let _ = write!(out, " (captures{})", vars(&f.captures));
        }
        block(&mut out, &f.body, 4);
        out.push(')');
    }
    let _ = write!(out, "\n  (entry {}))", quoted(&module.entry));
    out
}

fn vars(names: &[Name]) -> String {
    names.iter().map(|n| format!(" ${n}")).collect()
}

fn list(names: &[Name]) -> String {
    format!("({})", vars(names).trim_start())
}

fn tail(items: &[Expr]) -> String {
    items.iter().map(|e| format!(" {}", expr(e))).collect()
}

fn block(out: &mut String, stmts: &[Stmt], indent: usize) {
    for s in stmts {
        let _ = write!(out, "\n{:indent$}", "");
        let nested = |out: &mut String, head: &str, body: &[Stmt]| {
            let _ = write!(out, "\n{:1$}({head}", "", indent + 2);
            block(out, body, indent + 4);
            out.push(')');
        };
        match &s.kind {
            StmtKind::Set(x, e) => _ = write!(out, "(set ${x} {})", expr(e)),
            StmtKind::Unpack(xs, e) => _ = write!(out, "(unpack {} {})", list(xs), expr(e)),
            StmtKind::UnpackStar(a, r, c, e) => {
                _ = write!(out, "(unpack_star {} ${r} {} {})", list(a), list(c), expr(e));
            }
            StmtKind::If(c, a, b) => {
                let _ = write!(out, "(if {}", expr(c));
                nested(out, "then", a);
                nested(out, "else", b);
                out.push(')');
            }
            StmtKind::For(x, e, body) => {
                let _ = write!(out, "(for ${x} {}", expr(e));
                nested(out, "body", body);
                out.push(')');
            }
            StmtKind::While(c, body) => {
                let _ = write!(out, "(while {}", expr(c));
                nested(out, "body", body);
                out.push(')');
            }
            StmtKind::Break => out.push_str("(break)"),
            StmtKind::Continue => out.push_str("(continue)"),
            StmtKind::Return(e) => _ = write!(out, "(return {})", expr(e)),
            StmtKind::Do(e) => _ = write!(out, "(do {})", expr(e)),
            StmtKind::Assert(c, m) => _ = write!(out, "(assert {} {})", expr(c), expr(m)),
        }
    }
}

/// An expression, without places and labels.
pub(crate) fn expression(e: &Expr) -> String {
    expr(e)
}

fn expr(e: &Expr) -> String {
    use ExprKind::*;
    let two = |head: &str, a: &Expr, b: &Expr| format!("({head} {} {})", expr(a), expr(b));
    match &e.kind {
        Literal(l) => literal(l),
        Data(k) => format!("(data {k})"),
        Var(x) => format!("${x}"),
        And(items) => format!("(and{})", tail(items)),
        Or(items) => format!("(or{})", tail(items)),
        Cond(c, a, b) => format!("(cond {} {} {})", expr(c), expr(a), expr(b)),
        Call(f, args) => format!("(call {}{})", quoted(f), tail(args)),
        Closure(f, args) => format!("(closure {}{})", quoted(f), tail(args)),
        Apply(f, args) => format!("(apply {}{})", expr(f), tail(args)),
        Sample(d, None) => format!("(sample {})", expr(d)),
        Sample(d, Some(options)) => two("sample", d, options),
        Observe(d, v) => two("observe", d, v),
        Factor(x) => format!("(factor {})", expr(x)),
        Condition(x) => format!("(condition {})", expr(x)),
        Query(k, v) => two("query", k, v),
        Place(frame, call) => two("place", frame, call),
        Emit(args) => format!("(emit{})", tail(args)),
        Force(x) => format!("(force {})", expr(x)),
        Mem(f, None) => format!("(mem {})", expr(f)),
        Mem(f, Some(name)) => format!("(mem {} {})", expr(f), quoted(name)),
        Future(f, args) => format!("(future {}{})", quoted(f), tail(args)),
        FutureApply(f, args) => format!("(future_apply {}{})", expr(f), tail(args)),
        Dist(f, args) => match is_word(f) {
            true => format!("(dist {f}{})", tail(args)),
            false => format!("(dist {}{})", quoted(f), tail(args)),
        },
        Host(k, args) => format!("(host {k}{})", tail(args)),
        Record(k, args) => format!("(record {k}{})", tail(args)),
        Field(x, f) => format!("(field {} {})", expr(x), quoted(f)),
        List(args) => format!("(list{})", tail(args)),
        Tuple(args) => format!("(tuple{})", tail(args)),
        Dict(keys, args) => format!("(dict ({}){})", tail(keys).trim_start(), tail(args)),
        Method(x, f, args) => format!("(method {} {}{})", expr(x), quoted(f), tail(args)),
        Op(f, args) => format!("({f}{})", tail(args)),
    }
}

fn literal(l: &Literal) -> String {
    match l {
        Literal::None => "none".into(),
        Literal::Bool(b) => b.to_string(),
        Literal::Int(i) => i.to_string(),
        Literal::Real(x) if x.is_nan() => "nan".into(),
        Literal::Real(x) if x.is_infinite() => if *x > 0.0 { "inf" } else { "-inf" }.into(),
        Literal::Real(x) => format!("{x:?}"),
        Literal::Str(s) => quoted(s),
    }
}

fn is_word(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// A string with the escapes that [`super::read`] resolves.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            c if (c as u32) < 0x20 => _ = write!(out, "\\u{:04x}", c as u32),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::super::parse::parse;
    use super::*;

    #[test]
    fn printing_a_parsed_text_again_changes_nothing() {
        let text = r#"(module (file 0 "m.py") (class 0 "P" ("x" "y")) (const 0 (list 1 2.5))
          (fn @1:1-9:2 "m" (file 0) (params $a $b) (defaults 3) (captures $c)
            (set @2:3-2:9 $x (add $a (lit @2:4-2:5 1e-3)))
            (unpack ($p $q) (data 0))
            (unpack_star ($p) $r ($s) (data 0))
            (if (lt $x 2) (then (return $p)) (else (do (factor -inf))))
            (for $i (range 3) (body (if (eq $i 1) (then (continue))) (break)))
            (while (not $x) (body (set $x (cond $x 1 "a\n\"b\""))))
            (assert true "m")
            (do (query "k" (method (dict ("a") 1) "get" "a"))))
          (entry "m"))"#;
        let once = print(&parse(text).unwrap());
        assert_eq!(once, print(&parse(&once).unwrap()));
        assert!(once.contains("(set $x (cond $x 1 \"a\\u000a\\\"b\\\"\"))"));
    }
    #[test]
    fn printed_names_of_any_characters_are_read_back() {
        let text = "(module (class 0 \"a\\u0000b\" (\"\u{200b}\")) (fn \"m\\\\\" (params) (return (dist \"g h\" (call \"m\\\\\"))))\
                    (entry \"m\\\\\"))";
        let once = print(&parse(text).unwrap());
        assert_eq!(once, print(&parse(&once).unwrap()));
        assert!(
            once.contains("\"a\\u0000b\" (\"\u{200b}\")") && once.contains("(dist \"g h\" (call \"m\\\\\"))")
        );
    }
}
