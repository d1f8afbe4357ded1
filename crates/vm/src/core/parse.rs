//! Nested lists to core form.

use super::deep::with_stack;
use super::read::{CoreError, Sexp, read};
use super::*;

type Result<T> = std::result::Result<T, CoreError>;

/// Parses the text of a whole module.
///
/// # Errors
/// Text that is not core form, or nested too deeply.
pub fn parse(text: &str) -> Result<Module> {
    with_stack(|| parse_here(text)).unwrap_or_else(|error| Err(CoreError::new(format!("no thread: {error}"))))
}

fn parse_here(text: &str) -> Result<Module> {
    let sexp = read(text)?;
    let Form { head, items, .. } = form(&sexp)?;
    if head != "module" {
        return Err(CoreError::new("expected (module ...)"));
    }
    let mut module = Module::default();
    let mut entry = None;
    for item in items {
        let Form { head, span, items: args, .. } = form(item)?;
        match head {
            "file" => {
                in_order(arg(args, 0, head)?, module.files.len(), head)?;
                module.files.push(text_of(arg(args, 1, head)?)?.to_string());
            }
            "class" => module.classes.push(Class {
                id: in_order(arg(args, 0, head)?, module.classes.len(), head)?,
                kind: match args.get(3) {
                    Some(Sexp::Atom("namedtuple")) => ClassKind::NamedTuple,
                    _ => ClassKind::Dataclass,
                },
                name: text_of(arg(args, 1, head)?)?.to_string(),
                fields: list(arg(args, 2, head)?)?
                    .iter()
                    .map(|s| Ok(text_of(s)?.to_string()))
                    .collect::<Result<_>>()?,
            }),
            "const" => {
                let at = number(arg(args, 0, head)?)?;
                if at > usize::from(u16::MAX) {
                    return Err(CoreError::new(format!("({head} {at} ...): there are at most 65536")));
                }
                module.constants.push((at, expr(arg(args, 1, head)?)?));
            }
            "fn" => module.functions.push(function(span, args)?),
            "entry" => entry = Some(name(arg(args, 0, head)?)?),
            other => return Err(CoreError::new(format!("unknown item `{other}` in a module"))),
        }
    }
    module.entry = entry.ok_or_else(|| CoreError::new("a module without an entry"))?;
    Ok(module)
}

fn function(span: Span, args: &[Sexp<'_>]) -> Result<Function> {
    let mut f = Function {
        name: name(arg(args, 0, "fn")?)?,
        file: 0,
        span,
        params: vec![],
        defaults: vec![],
        captures: vec![],
        body: vec![],
    };
    let mut items = &args[1..];
    // The place may also follow the name.
    if let [Sexp::Atom(a), rest @ ..] = items
        && let Some(text) = a.strip_prefix('@')
    {
        (f.span, items) = (self::span(text)?, rest);
    }
    for item in items {
        let Form { head, items: rest, .. } = form(item)?;
        match head {
            "file" => f.file = small(arg(rest, 0, head)?)?,
            "params" => f.params = vars(rest)?,
            "captures" => f.captures = vars(rest)?,
            "defaults" => f.defaults = rest.iter().map(expr).collect::<Result<_>>()?,
            _ => f.body.push(stmt(item)?),
        }
    }
    if f.defaults.len() > f.params.len() {
        return Err(CoreError::new(format!("`{}` has more defaults than parameters", f.name)));
    }
    Ok(f)
}

fn block(sexp: &Sexp<'_>, expected: &str) -> Result<Vec<Stmt>> {
    let Form { head, items, .. } = form(sexp)?;
    if head != expected {
        return Err(CoreError::new(format!("expected ({expected} ...), found ({head} ...)")));
    }
    items.iter().map(stmt).collect()
}

fn stmt(sexp: &Sexp<'_>) -> Result<Stmt> {
    let Form { head, span, label, items: args } = form(sexp)?;
    let at = |i| arg(args, i, head);
    let kind = match head {
        "set" => StmtKind::Set(var(at(0)?)?, expr(at(1)?)?),
        "unpack" => StmtKind::Unpack(vars(list(at(0)?)?)?, expr(at(1)?)?),
        "unpack_star" => {
            StmtKind::UnpackStar(vars(list(at(0)?)?)?, var(at(1)?)?, vars(list(at(2)?)?)?, expr(at(3)?)?)
        }
        "if" => StmtKind::If(
            expr(at(0)?)?,
            block(at(1)?, "then")?,
            if args.len() > 2 { block(at(2)?, "else")? } else { vec![] },
        ),
        "for" => StmtKind::For(var(at(0)?)?, expr(at(1)?)?, block(at(2)?, "body")?),
        "while" => StmtKind::While(expr(at(0)?)?, block(at(1)?, "body")?),
        "break" => StmtKind::Break,
        "continue" => StmtKind::Continue,
        "return" => StmtKind::Return(expr(at(0)?)?),
        "do" => StmtKind::Do(expr(at(0)?)?),
        "assert" => StmtKind::Assert(expr(at(0)?)?, expr(at(1)?)?),
        other => return Err(CoreError::new(format!("unknown statement `{other}`"))),
    };
    Ok(Stmt { span, label, kind })
}

fn exprs(items: &[Sexp<'_>]) -> Result<Vec<Expr>> {
    items.iter().map(expr).collect()
}

/// Parses one expression.
pub fn expr(sexp: &Sexp<'_>) -> Result<Expr> {
    let kind = match sexp {
        Sexp::Text(s) => ExprKind::Literal(Literal::Str(s.clone())),
        Sexp::Atom(a) if a.starts_with('$') => ExprKind::Var(Name::from(&a[1..])),
        Sexp::Atom(a) => ExprKind::Literal(literal(a)?),
        Sexp::List(_) => return compound(sexp),
    };
    Ok(Expr { span: Span::default(), label: None, kind })
}

fn compound(sexp: &Sexp<'_>) -> Result<Expr> {
    let Form { head, span, label, items: args } = form(sexp)?;
    let at = |i| arg(args, i, head);
    let boxed = |i| -> Result<Box<Expr>> { Ok(Box::new(expr(arg(args, i, head)?)?)) };
    let tail = |i: usize| exprs(args.get(i..).unwrap_or(&[]));
    let kind = match head {
        "lit" => return Ok(Expr { span, label: None, kind: expr(at(0)?)?.kind }),
        "var" => ExprKind::Var(var(at(0)?)?),
        "data" => ExprKind::Data(number(at(0)?)?),
        "and" => ExprKind::And(tail(0)?),
        "or" => ExprKind::Or(tail(0)?),
        "cond" => ExprKind::Cond(boxed(0)?, boxed(1)?, boxed(2)?),
        "call" => ExprKind::Call(name(at(0)?)?, tail(1)?),
        "closure" => ExprKind::Closure(name(at(0)?)?, tail(1)?),
        "apply" => ExprKind::Apply(boxed(0)?, tail(1)?),
        "sample" => ExprKind::Sample(boxed(0)?, args.get(1).map(|_| boxed(1)).transpose()?),
        "observe" => ExprKind::Observe(boxed(0)?, boxed(1)?),
        "factor" => ExprKind::Factor(boxed(0)?),
        "condition" => ExprKind::Condition(boxed(0)?),
        "query" => ExprKind::Query(boxed(0)?, boxed(1)?),
        "emit" => ExprKind::Emit(tail(0)?),
        "place" => {
            let (frame, call) = (boxed(0)?, boxed(1)?);
            if !matches!(call.kind, ExprKind::Call(..) | ExprKind::Apply(..)) {
                return Err(CoreError::new("`place` needs a call"));
            }
            ExprKind::Place(frame, call)
        }
        "force" => ExprKind::Force(boxed(0)?),
        "mem" => ExprKind::Mem(boxed(0)?, args.get(1).map(name).transpose()?),
        "future" => ExprKind::Future(name(at(0)?)?, tail(1)?),
        "future_apply" => ExprKind::FutureApply(boxed(0)?, tail(1)?),
        "dist" => ExprKind::Dist(name(at(0)?)?, tail(1)?),
        "host" => ExprKind::Host(number(at(0)?)?, tail(1)?),
        "record" => ExprKind::Record(number(at(0)?)?, tail(1)?),
        "field" => ExprKind::Field(boxed(0)?, name(at(1)?)?),
        "list" => ExprKind::List(tail(0)?),
        "tuple" => ExprKind::Tuple(tail(0)?),
        "dict" => {
            let (keys, values) = (exprs(list(at(0)?)?)?, tail(1)?);
            if keys.len() != values.len() {
                let counts = format!("{} keys and {} values", keys.len(), values.len());
                return Err(CoreError::new(format!("a dict with {counts}")));
            }
            if !keys.iter().all(|key| matches!(key.kind, ExprKind::Literal(_))) {
                return Err(CoreError::new("a dict's keys must be literals"));
            }
            ExprKind::Dict(keys, values)
        }
        "method" => {
            let mut rest = vec![expr(at(0)?)?];
            let method = name(at(1)?)?;
            rest.extend(tail(2)?);
            let receiver = rest.remove(0);
            ExprKind::Method(Box::new(receiver), method, rest)
        }
        op => ExprKind::Op(Name::from(op), tail(0)?),
    };
    Ok(Expr { span, label, kind })
}

fn literal(atom: &str) -> Result<Literal> {
    Ok(match atom {
        "true" => Literal::Bool(true),
        "false" => Literal::Bool(false),
        "none" => Literal::None,
        "inf" => Literal::Real(f64::INFINITY),
        "-inf" => Literal::Real(f64::NEG_INFINITY),
        "nan" => Literal::Real(f64::NAN),
        _ => {
            if let Ok(i) = atom.parse::<i64>() {
                Literal::Int(i)
            } else if atom.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+' || c == '.') {
                Literal::Real(atom.parse().map_err(|_| CoreError::new(format!("`{atom}` is not a number")))?)
            } else {
                return Err(CoreError::new(format!("`{atom}` is not a literal")));
            }
        }
    })
}

/// The parts of a list: `(head @span #label items...)`, where span and label are optional.
struct Form<'s, 'a> {
    head: &'a str,
    span: Span,
    label: Option<Name>,
    items: &'s [Sexp<'a>],
}

fn form<'s, 'a>(sexp: &'s Sexp<'a>) -> Result<Form<'s, 'a>> {
    let Sexp::List(items) = sexp else {
        return Err(CoreError::new(format!("expected a list, found {}", short(sexp))));
    };
    let Some(Sexp::Atom(head)) = items.first() else {
        return Err(CoreError::new("a list that does not start with a word"));
    };
    let mut form = Form { head, span: Span::default(), label: None, items: &items[1..] };
    if let [Sexp::Atom(a), rest @ ..] = form.items
        && let Some(text) = a.strip_prefix('@')
    {
        (form.span, form.items) = (span(text)?, rest);
    }
    if let [Sexp::Atom(a), rest @ ..] = form.items
        && let Some(text) = a.strip_prefix('#')
    {
        (form.label, form.items) = (Some(Name::from(text)), rest);
    }
    Ok(form)
}

/// `14:9-14:31`.
fn span(text: &str) -> Result<Span> {
    let bad = || CoreError::new(format!("`@{text}` is not a place"));
    let mut numbers = text.split([':', '-']).map(str::parse::<u32>);
    let mut next = || numbers.next().and_then(std::result::Result::ok).ok_or_else(bad);
    Ok(Span { line: next()?, column: next()?, end_line: next()?, end_column: next()? })
}

fn arg<'s, 'a>(args: &'s [Sexp<'a>], i: usize, head: &str) -> Result<&'s Sexp<'a>> {
    args.get(i).ok_or_else(|| CoreError::new(format!("({head} ...) needs more than {i} parts")))
}

fn list<'s, 'a>(sexp: &'s Sexp<'a>) -> Result<&'s [Sexp<'a>]> {
    match sexp {
        Sexp::List(items) => Ok(items),
        other => Err(CoreError::new(format!("expected a list, found {}", short(other)))),
    }
}

fn text_of<'s>(sexp: &'s Sexp<'_>) -> Result<&'s str> {
    match sexp {
        Sexp::Text(s) => Ok(s),
        Sexp::Atom(a) => Ok(a),
        Sexp::List(_) => Err(CoreError::new("expected a name, found a list")),
    }
}

fn name(sexp: &Sexp<'_>) -> Result<Name> {
    Ok(Name::from(text_of(sexp)?))
}

fn number(sexp: &Sexp<'_>) -> Result<usize> {
    text_of(sexp)?.parse().map_err(|_| CoreError::new(format!("expected a number, found {}", short(sexp))))
}

/// A number that fits in 32 bits.
fn small(sexp: &Sexp<'_>) -> Result<u32> {
    let value = number(sexp)?;
    u32::try_from(value).map_err(|_| CoreError::new(format!("the number {value} is too large")))
}

/// Reads the number of an item of the module, which must be `next`.
fn in_order(sexp: &Sexp<'_>, next: usize, head: &str) -> Result<u32> {
    let number = small(sexp)?;
    if number as usize == next {
        return Ok(number);
    }
    Err(CoreError::new(format!("({head} {number} ...), expected ({head} {next} ...)")))
}

/// Describes an S-expression for a message.
fn short(sexp: &Sexp<'_>) -> String {
    match sexp {
        Sexp::Atom(text) => format!("`{}`", text.chars().take(40).collect::<String>()),
        Sexp::Text(text) => format!("the string {:?}", text.chars().take(40).collect::<String>()),
        Sexp::List(items) => format!("a list of {}", items.len()),
    }
}

fn var(sexp: &Sexp<'_>) -> Result<Name> {
    match sexp {
        Sexp::Atom(a) if a.starts_with('$') => Ok(Name::from(&a[1..])),
        other => Err(CoreError::new(format!("expected a variable, found {}", short(other)))),
    }
}

fn vars(items: &[Sexp<'_>]) -> Result<Vec<Name>> {
    items.iter().map(var).collect()
}
