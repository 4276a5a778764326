//! A file of values for `#read`: numbers, vectors and strings with commas between them.
//!
//! POV-Ray takes the token after each value for its comma, whatever it is: of `1 2 3` it reads 1 and 3. This reader
//! does the same, and warns.

use crate::base::args::Parse;
use crate::base::source::Diagnostic;
use crate::lang::expr::value::{Number, Value};
use crate::lang::syntax::{Kind, Token, Tokens};
use std::rc::Rc;

/// An open file of values.
#[derive(Debug)]
pub(crate) struct DataFile {
    name: String,
    tokens: Rc<Tokens>,
    at: usize,
    is_at_end: bool,
}

impl DataFile {
    /// The file with these tokens, at its start.
    pub(crate) fn new(name: String, tokens: Rc<Tokens>) -> Self {
        DataFile {
            name,
            tokens,
            at: 0,
            is_at_end: false,
        }
    }

    /// The name by which the scene opened it.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// True once the end was reached: after a value without a comma, or where a value was expected.
    pub(crate) fn is_at_end(&self) -> bool {
        self.is_at_end
    }

    /// The next value, `None` at the end of the file.
    pub(crate) fn next(&mut self, warn: &mut dyn FnMut(Diagnostic)) -> Parse<Option<Value>> {
        if self.is_at_end || self.token().kind == Kind::End {
            self.is_at_end = true;
            return Ok(None);
        }
        let value = self.value()?;
        match self.token() {
            token if token.kind == Kind::End => self.is_at_end = true,
            token => {
                if !token.is_mark(',') {
                    let message = "there is no comma here, and what is written instead is ignored";
                    let hint = "Values that are read have commas between them.";
                    let span = self.tokens.span(self.at);
                    warn(Diagnostic::warning(span, message).with_hint(hint));
                }
                self.at += 1;
            }
        }
        Ok(Some(value))
    }

    fn token(&self) -> Token {
        self.tokens.tokens[self.at]
    }

    fn value(&mut self) -> Parse<Value> {
        let token = self.token();
        match token.kind {
            Kind::String => {
                self.at += 1;
                Ok(Value::Text(self.tokens.string(token.value).into()))
            }
            Kind::Mark if token.is_mark('<') => self.vector().map(Value::Number),
            _ => Ok(Value::Number(Number::float(self.number()?))),
        }
    }

    fn vector(&mut self) -> Parse<Number> {
        self.at += 1;
        let mut number = Number {
            v: [0.0; 5],
            len: 0,
        };
        while !self.token().is_mark('>') {
            if number.len == 5 {
                return Err(self.expected("`>` after five components"));
            }
            number.v[usize::from(number.len)] = self.number()?;
            number.len += 1;
            self.at += usize::from(self.token().is_mark(','));
        }
        if number.len < 2 {
            return Err(self.expected("a further component of the vector"));
        }
        self.at += 1;
        Ok(number)
    }

    fn number(&mut self) -> Parse<f64> {
        let is_negative = self.token().is_mark('-');
        self.at += usize::from(is_negative || self.token().is_mark('+'));
        let token = self.token();
        if token.kind != Kind::Number {
            return Err(self.expected("a number, a vector or a string"));
        }
        self.at += 1;
        let value = self.tokens.numbers[token.value as usize];
        Ok(if is_negative { -value } else { value })
    }

    fn expected(&self, what: &str) -> Box<Diagnostic> {
        let span = self.tokens.span(self.at);
        let found = match self.token().kind {
            Kind::End => "the end of the file".to_owned(),
            _ => {
                let text = self.tokens.text();
                let token = text.get(span.start as usize..span.end as usize);
                format!("`{}`", token.unwrap_or_default())
            }
        };
        let error = Diagnostic::error(span, format!("expected {what}, found {found}"));
        Box::new(error.with_hint("A file that is read holds values only, no expressions."))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::source::FileId;
    use crate::lang::syntax::{Names, tokenize};

    /// The values of a file, and the number of warnings they gave.
    fn values(text: &str) -> (Vec<String>, usize) {
        let tokens = tokenize(FileId(0), &String::from(text).into(), &mut Names::new()).unwrap();
        let mut file = DataFile::new("d".to_owned(), Rc::new(tokens));
        let (mut found, mut warnings) = (Vec::new(), 0);
        while !file.is_at_end() {
            found.push(match file.next(&mut |_| warnings += 1) {
                Ok(Some(Value::Number(number))) => {
                    format!("{:?}", &number.v[..usize::from(number.len)])
                }
                Ok(Some(Value::Text(text))) => text.letters().to_owned(),
                Ok(other) => format!("{other:?}"),
                Err(error) => {
                    found.push(error.message);
                    break;
                }
            });
        }
        (found, warnings)
    }

    /// Measured with POV-Ray.
    #[test]
    fn values_need_commas() {
        let (found, warnings) = values("1,2,3\n4 5\n-6, - 7, +8");
        assert_eq!(
            found,
            [
                "[1.0]", "[2.0]", "[3.0]", "[5.0]", "[6.0]", "[-7.0]", "[8.0]"
            ]
        );
        assert_eq!(warnings, 2);
    }

    #[test]
    fn behind_a_comma_the_end_is_reached_by_a_further_read() {
        assert_eq!(values("1,<2,-3 4>,\"a\\n\"").0.len(), 3);
        assert_eq!(values("1, // last\n").0, ["[1.0]", "None"]);
        assert_eq!(values("").0, ["None"]);
    }

    #[test]
    fn other_tokens_are_errors() {
        let told = "expected a number, a vector or a string, found ";
        assert_eq!(values("1,foo").0[1], format!("{told}`foo`"));
        assert_eq!(values("1,-<1,2,3>").0[1], format!("{told}`<`"));
        assert_eq!(values("<1,2").0[0], format!("{told}the end of the file"));
        assert_eq!(
            values("<1>").0[0],
            "expected a further component of the vector, found `>`"
        );
    }
}
