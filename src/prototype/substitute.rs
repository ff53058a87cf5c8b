//! The two references that a value may hold: `$`, the instance's id, and `${name}`, the value of a parameter.

/// `text` with each `${name}` replaced by what `parameter` gives for the name, and every other `$` by `instance`.
///
/// `$.Gantry.X` is how the reference names a joint of an instance. The error is the first name that `parameter` does
/// not know; a `${` without its `}` counts as one.
pub fn substitute<'a>(
    text: &str,
    instance: &str,
    parameter: impl Fn(&str) -> Option<&'a str>,
) -> Result<String, String> {
    let mut result = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('$') {
        result.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        let Some(reference) = rest.strip_prefix('{') else {
            result.push_str(instance);
            continue;
        };
        let (name, after) = reference.split_once('}').ok_or_else(|| reference.to_owned())?;
        result.push_str(parameter(name).ok_or_else(|| name.to_owned())?);
        rest = after;
    }
    result.push_str(rest);
    Ok(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_are_replaced_and_everything_else_stays() {
        let parameter = |name: &str| (name == "length").then_some("2.0");
        let check = |text: &str, expect: Result<&str, &str>| {
            let read = substitute(text, "Belt", parameter);
            assert_eq!(read.as_deref().map_err(String::as_str), expect, "{text}");
        };
        check("0.3;1.7", Ok("0.3;1.7"));
        check("${length}", Ok("2.0"));
        check("${length};${length} m", Ok("2.0;2.0 m"));
        check("$.Spintore.T", Ok("Belt.Spintore.T"));
        check("$", Ok("Belt"));
        check("$$", Ok("BeltBelt"));
        check("${width}", Err("width"));
        check("${length", Err("length"));
    }
}
