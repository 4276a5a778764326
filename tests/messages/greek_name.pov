// mistakes in lines 2, 3: a Greek letter in a name
#declare Αpple = 1;
sphere { 0, Αpple }
