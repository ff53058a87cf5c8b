//! Values as JSON, by their type.
//!
//! | type | JSON |
//! | --- | --- |
//! | BOOL | `true`, `false` |
//! | SINT to ULINT, BYTE to LWORD | a number without a fraction; `1.0` and `1e2` are such |
//! | REAL, LREAL | a number; written with the fewest digits that read back as the same value |
//! | TIME | a number of milliseconds, down to nanoseconds: `1.5`, `0.000001` |
//! | STRING | by [`TextForm`] |
//! | WSTRING | by [`TextForm`] |
//! | array | an array of as many elements as declared |

mod read;
mod write;

pub use read::{Unfit, read_value};
pub use write::{NotFinite, write_value};
pub(in crate::wire) use write::{write_number, write_string};

/// How texts stand in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextForm {
    /// As the CPS-Protocol has them: a STRING is the base64 (RFC 4648, padded) of its bytes, a WSTRING that of its UTF-16
    /// code units, low byte first. The latter is ours, the source shows a STRING alone.
    Base64,
    /// As the IO data model has them ("a string corresponding to the IEC 61499 STRING type"): a JSON string. Each byte of
    /// a STRING is the character of that number (ISO/IEC 10646, row 00, as IEC 61131-3 has it).
    Plain,
}

#[cfg(test)]
mod tests {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use proptest::prelude::*;

    use super::*;
    use crate::value::{ElementaryType, STRING_CAPACITY, SignalType, Value};
    use crate::wire::Raw;
    use crate::wire::tests::texts;

    fn read(json: &str, ty: &str) -> Result<Value, Unfit> {
        read_value(Raw::new(json).expect(json), ty.parse().expect(ty), TextForm::Base64)
    }

    #[track_caller]
    fn reads(json: &str, ty: &str, expect: Value) {
        assert_eq!(read(json, ty), Ok(expect), "{json} as {ty}");
    }

    #[track_caller]
    fn unfit(json: &str, ty: &str, result: i64, message: &str) {
        let error = read(json, ty).expect_err(json);
        assert_eq!((error.result.0, error.message.as_str()), (result, message), "{json} as {ty}");
    }

    fn written(value: Value) -> String {
        let mut out = String::new();
        write_value(&mut out, &value, TextForm::Base64).expect("a value with a JSON form");
        out
    }

    #[test]
    fn a_number_without_a_fraction_is_an_integer() {
        reads("1.0", "DINT", Value::Dint(1));
        reads("1e2", "SINT", Value::Sint(100));
        reads("-0.0", "LINT", Value::Lint(0));
        reads("18446744073709551615", "LWORD", Value::Lword(u64::MAX));
        reads("9007199254740993", "LINT", Value::Lint(9_007_199_254_740_993));
    }

    #[test]
    fn a_fraction_for_an_integer_is_a_wrong_value() {
        unfit("0.5", "DINT", 422, "expected DINT, a whole number, found 0.5");
        unfit("1e-400", "USINT", 422, "expected USINT, a whole number, found 1e-400");
    }

    #[test]
    fn a_number_outside_its_type_is_a_wrong_value() {
        unfit("128", "SINT", 422, "128 is outside SINT, -128 to 127");
        unfit("-1", "BYTE", 422, "-1 is outside BYTE, 0 to 255");
        unfit("18446744073709551616", "ULINT", 422, "18446744073709551616 is outside ULINT, 0 to 18446744073709551615");
        unfit("1e400", "LINT", 422, "1e400 is outside LINT, -9223372036854775808 to 9223372036854775807");
        unfit("1e400", "LREAL", 422, "1e400 is outside LREAL, at most 1.7976931348623157e308 either way");
        unfit("-3.5e38", "REAL", 422, "-3.5e38 is outside REAL, at most 3.4028234663852886e38 either way");
        unfit("1e13", "TIME", 422, "1e13 ms is outside TIME, at most 9223372036854 ms either way");
    }

    #[test]
    fn another_kind_of_json_value_is_a_wrong_type() {
        unfit("null", "REAL", 415, "expected REAL, a number, found null");
        unfit("{}", "DINT", 415, "expected DINT, a whole number, found an object, {}");
        unfit("1", "BOOL", 415, "expected BOOL, true or false, found a number, 1");
        unfit("true", "REAL", 415, "expected REAL, a number, found a boolean, true");
        unfit("\"1\"", "TIME", 415, "expected TIME, a number of milliseconds, found a string, \"1\"");
        unfit("7", "STRING", 415, "expected STRING, a base64 string, found a number, 7");
        unfit("7", "REAL[2]", 415, "expected REAL[2], an array, found a number, 7");
        unfit("[7]", "REAL", 415, "expected REAL, a number, found an array, [7]");
    }

    #[test]
    fn arrays_have_as_many_elements_as_declared_and_each_is_checked() {
        reads("[1, 2.0]", "INT[2]", Value::Array([Value::Int(1), Value::Int(2)].into()));
        unfit("[1]", "INT[2]", 415, "expected INT[2], an array of 2 elements, found one of 1");
        unfit("[]", "INT[2]", 415, "expected INT[2], an array of 2 elements, found one of 0");
        unfit("[1, null]", "INT[2]", 415, "element 1: expected INT, a whole number, found null");
        unfit("[1, 70000]", "INT[2]", 422, "element 1: 70000 is outside INT, -32768 to 32767");
        unfit("[[1], 2]", "INT[2]", 415, "element 0: expected INT, a whole number, found an array, [1]");
    }

    #[test]
    fn texts_are_base64() {
        reads("\"T0s=\"", "STRING", Value::String((*b"OK").into()));
        reads("\"T0s\\u003d\"", "STRING", Value::String((*b"OK").into()));
        reads("\"\"", "STRING", Value::String(Box::default()));
        reads("\"TwBLAA==\"", "WSTRING", Value::Wstring("OK".encode_utf16().collect()));
        unfit("\"T0s\"", "STRING", 422, "expected STRING, as base64, found \"T0s\"");
        unfit("\"no base64\"", "STRING", 422, "expected STRING, as base64, found \"no base64\"");
        unfit("\"T0tL\"", "WSTRING", 422, "expected WSTRING, pairs of bytes as base64, found 3 bytes");
        let long = format!("\"{}\"", STANDARD.encode([b'x'; STRING_CAPACITY + 1]));
        unfit(&long, "STRING", 422, "expected STRING, at most 254 characters, found 255");
    }

    #[test]
    fn plain_texts_are_json_strings() {
        let read = |json, ty: &str| read_value(Raw::new(json).expect(json), ty.parse().expect(ty), TextForm::Plain);
        assert_eq!(read("\"OK\"", "STRING"), Ok(Value::String((*b"OK").into())));
        assert_eq!(read("\"\\u00e9\"", "STRING"), Ok(Value::String([0xe9].into())));
        let error = read("\"\\u20ac\"", "STRING").expect_err("a euro");
        assert_eq!(error.to_string(), "\"\\u20ac\" holds a character beyond the 256 of STRING");
        assert_eq!(read("\"\\u20ac\"", "WSTRING"), Ok(Value::Wstring([0x20ac].into())));
    }

    #[test]
    fn times_are_milliseconds() {
        reads("1.5", "TIME", Value::Time(1_500_000));
        reads("0.0000014", "TIME", Value::Time(1));
        assert_eq!(written(Value::Time(-20_000_000)), "-20");
        assert_eq!(written(Value::Time(1)), "0.000001");
        assert_eq!(written(Value::Time(i64::MIN)), "-9223372036854.775808");
    }

    #[test]
    fn a_real_is_written_in_the_fewest_digits_that_read_back() {
        assert_eq!(written(Value::Real(0.5776)), "0.5776");
        assert_eq!(written(Value::Real(900.0)), "900.0");
        assert_eq!(written(Value::Real(1e-14)), "1e-14");
        assert_eq!(written(Value::Lreal(f64::from(0.5776f32))), "0.5776000022888184");
        // Rounded once: by way of an f64, this would become 1.0000001.
        reads("1.00000005960464477540", "REAL", Value::Real(1.000_000_1));
        reads("1.00000005960464477539", "REAL", Value::Real(1.0));
    }

    #[test]
    fn negative_zero_is_zero() {
        assert_eq!(written(Value::Real(-0.0)), "0.0");
        for text in ["-0.0", "-1e-60"] {
            let Ok(Value::Real(zero)) = read(text, "REAL") else { panic!("{text} is no REAL") };
            assert_eq!(zero.to_bits(), 0, "{text}");
        }
    }

    fn scalars(element: ElementaryType) -> BoxedStrategy<Value> {
        let real = prop::num::f32::NORMAL | prop::num::f32::SUBNORMAL | prop::num::f32::ZERO;
        let lreal = prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO;
        match element {
            ElementaryType::Bool => any::<bool>().prop_map(Value::Bool).boxed(),
            ElementaryType::Sint => any::<i8>().prop_map(Value::Sint).boxed(),
            ElementaryType::Int => any::<i16>().prop_map(Value::Int).boxed(),
            ElementaryType::Dint => any::<i32>().prop_map(Value::Dint).boxed(),
            ElementaryType::Lint => any::<i64>().prop_map(Value::Lint).boxed(),
            ElementaryType::Usint => any::<u8>().prop_map(Value::Usint).boxed(),
            ElementaryType::Uint => any::<u16>().prop_map(Value::Uint).boxed(),
            ElementaryType::Udint => any::<u32>().prop_map(Value::Udint).boxed(),
            ElementaryType::Ulint => any::<u64>().prop_map(Value::Ulint).boxed(),
            ElementaryType::Real => real.prop_map(Value::Real).boxed(),
            ElementaryType::Lreal => lreal.prop_map(Value::Lreal).boxed(),
            ElementaryType::Byte => any::<u8>().prop_map(Value::Byte).boxed(),
            ElementaryType::Word => any::<u16>().prop_map(Value::Word).boxed(),
            ElementaryType::Dword => any::<u32>().prop_map(Value::Dword).boxed(),
            ElementaryType::Lword => any::<u64>().prop_map(Value::Lword).boxed(),
            ElementaryType::String => {
                prop::collection::vec(any::<u8>(), 0..=STRING_CAPACITY).prop_map(|v| Value::String(v.into())).boxed()
            }
            ElementaryType::Wstring => {
                prop::collection::vec(any::<u16>(), 0..=STRING_CAPACITY).prop_map(|v| Value::Wstring(v.into())).boxed()
            }
            ElementaryType::Time => any::<i64>().prop_map(Value::Time).boxed(),
        }
    }

    fn values() -> impl Strategy<Value = Value> {
        prop::sample::select(ElementaryType::ALL.to_vec()).prop_flat_map(|element| {
            let arrays = prop::collection::vec(scalars(element), 1..6).prop_map(|v| Value::Array(v.into()));
            prop_oneof![scalars(element), arrays]
        })
    }

    /// Any JSON value of little depth.
    fn json() -> impl Strategy<Value = String> {
        let leaf = prop_oneof![
            Just("null".to_owned()),
            any::<bool>().prop_map(|b| b.to_string()),
            "-?(0|[1-9][0-9]{0,40})(\\.[0-9]{1,20})?([eE][+-]?[0-9]{1,5})?",
            texts().prop_map(|s| serde_json::json!(s).to_string()),
            "\"[A-Za-z0-9+/]{0,9}={0,2}\"",
        ];
        leaf.prop_recursive(2, 8, 4, |inner| {
            prop::collection::vec(inner, 0..4).prop_map(|v| format!("[{}]", v.join(",")))
        })
    }

    proptest! {
        #[test]
        fn every_value_reads_back_as_it_was_written(value in values()) {
            for form in [TextForm::Base64, TextForm::Plain] {
                let mut out = String::new();
                prop_assert_eq!(write_value(&mut out, &value, form), Ok(()));
                let raw = Raw::new(&out).expect("JSON");
                prop_assert_eq!(read_value(raw, value.signal_type(), form), Ok(value.clone()), "{}", out);
            }
        }

        #[test]
        fn whatever_json_comes_is_a_value_of_the_type_or_a_fault(json in json(), length in 0u16..4) {
            let raw = Raw::new(&json).expect("JSON");
            for element in ElementaryType::ALL {
                let ty = if length == 0 { SignalType::scalar(element) } else { SignalType::array(element, length) };
                for form in [TextForm::Base64, TextForm::Plain] {
                    match read_value(raw, ty, form) {
                        Ok(value) => prop_assert_eq!(value.signal_type(), ty),
                        Err(unfit) => prop_assert!(matches!(unfit.result.0, 415 | 422) && !unfit.message.is_empty()),
                    }
                }
            }
        }
    }
}
