// mistake in line 4: the `}` of an array is missing, in whose comment a shape is named
#declare A = array[2] // a sphere
{ 1, 2
box { 0, 1 }
