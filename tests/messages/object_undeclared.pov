// mistake in line 2: an undeclared object
object { Foo translate x }
