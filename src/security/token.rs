//! A bearer token (RFC 6750).

use std::fmt;

/// A secret that lets its bearer in. It does not print itself.
#[derive(Clone, PartialEq, Eq)]
pub struct Token(String);

/// A text that cannot be a token. It does not say which.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BadToken {
    #[error("the token is empty: expected visible ASCII characters")]
    Empty,
    #[error("the token holds a character that cannot stand in an HTTP header: expected visible ASCII characters")]
    Character,
}

impl Token {
    /// The token in `text`, blanks and line breaks around it left out.
    pub fn new(text: &str) -> Result<Token, BadToken> {
        let text = text.trim();
        match text {
            "" => Err(BadToken::Empty),
            _ if !text.bytes().all(|byte| byte.is_ascii_graphic()) => Err(BadToken::Character),
            _ => Ok(Token(text.to_owned())),
        }
    }

    /// The value of an `Authorization` header that carries it. This is the secret: mark it as sensitive.
    pub fn header(&self) -> String {
        format!("Bearer {}", self.0)
    }

    /// Whether `header`, the value of an `Authorization` header, carries it. Takes as long for a nearly right one as for
    /// any other of the same length, so that nobody finds it letter by letter.
    pub fn is_carried_by(&self, header: &[u8]) -> bool {
        let Some((scheme, given)) = header.split_at_checked(7) else { return false };
        let differing = given.iter().zip(self.0.as_bytes()).fold(0, |differing, (a, b)| differing | (a ^ b));
        scheme.eq_ignore_ascii_case(b"Bearer ") && given.len() == self.0.len() && differing == 0
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token(…)")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_carried_by_its_own_header_alone() {
        let token = Token::new(" opensesame\n").expect("a token");
        assert!(token.is_carried_by(token.header().as_bytes()));
        assert!(token.is_carried_by(b"bearer opensesame"), "the scheme's case is free");
        for other in
            ["", "Bearer", "Bearer ", "Bearer opensesam", "Bearer opensesame2", "Bearer openSesame", "Basic opensesame"]
        {
            assert!(!token.is_carried_by(other.as_bytes()), "{other}");
        }
    }

    #[test]
    fn what_cannot_stand_in_a_header_is_no_token() {
        assert_eq!(Token::new(" \n"), Err(BadToken::Empty));
        assert_eq!(Token::new("two words"), Err(BadToken::Character));
        assert_eq!(Token::new("schlüssel"), Err(BadToken::Character));
    }

    #[test]
    fn a_token_does_not_print_itself() {
        assert!(!format!("{:?}", Token::new("opensesame")).contains("sesame"));
    }
}
