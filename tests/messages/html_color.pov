// mistake in line 2: a colour of web pages that begins with digits
background { color #00ff00 }
