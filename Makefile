# `make run` and `make test` are all you need; `make help` lists the rest.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PORT ?= 8000
MAP ?= models/maps/helsinki.osm.pbf
INDEX ?= data/index
IMAGE ?= hereabouts
KILLS ?= 200
# Python compiles modules when it imports them; compiling all of them with pip would double the time.
PIP := $(BIN)/pip install --quiet --disable-pip-version-check --no-compile
# Each process takes 1 to 2 GB. A process gets a run of tests at a time, so that it makes a module's fixtures once.
PYTEST := $(BIN)/python -m pytest --numprocesses logical --maxprocesses 4 --dist worksteal
# pip installs this first. Set it for another build of torch, for example TORCH=./torch-2.13.0+cu130.whl.
TORCH ?= $(shell grep '^torch==' constraints.txt)
HELSINKI := --data models/maps/helsinki.osm.pbf
TRAINED_ON := --data data/towns-own-0 --data data/towns-own-1 $(HELSINKI)
FITTED_TO := --data data/towns-0 --data data/towns-own-1 $(HELSINKI)
# The shipped place kernels are also fitted to texts about midtown Manhattan, whose map does not ship. To make them again,
# set MIDTOWN=midtown.osm.pbf RVS=midtown_dev.jsonl.gz (docs/use.md#training); otherwise only the shipped maps are used.
TEXTS := models/reports/texts
comma := ,
PLACE_TEXTS := $(if $(MIDTOWN),--data $(MIDTOWN) --texts $(TEXTS)/manhattan_dev.jsonl$(if $(RVS),$(comma)$(RVS))) \
	$(HELSINKI) --texts $(TEXTS)/helsinki_west.jsonl \
	--data models/maps/alexanderplatz.osm.pbf --texts $(TEXTS)/alexanderplatz_dev.jsonl

# Some containers set this; every process would then compile torch's sources again, in four seconds.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help install run test test-fast fuzz load soak chaos check check-page format sbom audit towns train refit index serve evaluate benchmark web page wheels image clean

help:  ## list the targets
	@sed -n 's/^\([a-z-]*\):.*##/\1\t/p' $(MAKEFILE_LIST)

$(BIN)/.installed: pyproject.toml constraints.txt
	$(PYTHON) -m venv $(VENV)
	$(PIP) $(TORCH)
	$(PIP) --constraint constraints.txt --editable '.[dev]'
	touch $@

install: $(BIN)/.installed  ## create a virtual environment with everything in it

index: install  ## index MAP into INDEX, unless INDEX is up to date
	$(BIN)/hereabouts index --map $(MAP) --out $(INDEX) --keep-current

run: index  ## install, index the shipped city if needed, and serve it on PORT
	$(BIN)/hereabouts serve --index $(INDEX) --port $(PORT)

serve: install  ## serve INDEX on PORT
	$(BIN)/hereabouts serve --index $(INDEX) --port $(PORT)

test: install  ## run the whole test suite
	$(PYTEST)

test-fast: install  ## run the quick tests of every package
	$(PYTEST) -m 'not slow'

fuzz: install  ## fuzz the HTTP API and the pickle reader for much longer than the test suite does
	FUZZ_EXAMPLES=2000 FUZZ_MUTATIONS=10000 $(PYTEST) tests/app/http/test_contract.py tests/app/http/test_mutations.py \
		tests/models/sources/kitti360pose/test_pickle.py

load: install  ## measure throughput and overload behaviour (needs an idle machine)
	$(BIN)/python -m tests.load.load --index $(INDEX)

soak: install  ## check that memory does not grow over 100,000 requests
	$(BIN)/python -m tests.load.soak --index $(INDEX)

chaos: install  ## kill builds and the service KILLS times and switch versions 200 times; nothing acknowledged may be lost
	$(BIN)/python -m tests.load.chaos --kills $(KILLS)
	SWITCHES=200 $(BIN)/python -m pytest tests/app/http/test_switching.py

check: install  ## run ruff and mypy
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: install  ## format and fix the code with ruff
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

sbom: install  ## write reports/sbom.json, a CycloneDX list of the installed packages
	mkdir -p reports
	$(BIN)/cyclonedx-py environment --pyproject pyproject.toml --output-reproducible --output-file reports/sbom.json $(BIN)/python

# --strict, because otherwise packages that PyPI does not know would pass.
audit: install  ## look up known vulnerabilities of the pinned packages on PyPI
	$(BIN)/pip-audit --requirement constraints.txt --no-deps --disable-pip --strict --progress-spinner off

towns: install  ## make the synthetic towns for training, with and without --pieces own
	for towns in 0 own-0 own-1; do \
		test -d data/raw-$$towns || $(BIN)/hereabouts synth --seed $${towns#own-} --out data/raw-$$towns \
			--pieces $$(case $$towns in own-*) echo own;; *) echo official;; esac) && \
		$(BIN)/hereabouts prepare --raw data/raw-$$towns --out data/towns-$$towns || exit 1; \
	done

train: towns  ## train the shipped weights again
	$(BIN)/hereabouts train --method mncl $(TRAINED_ON) --out models/weights/retriever \
		--set model.width=128 --set training.batch_size=64 --set training.steps=2200
	$(BIN)/hereabouts train --method regressor $(TRAINED_ON) --out models/weights/regressor
	$(BIN)/hereabouts train --method matching $(TRAINED_ON) --out models/weights/matching
	$(BIN)/hereabouts train --method posterior $(FITTED_TO) --out models/weights/posterior
	$(BIN)/hereabouts train --method places --reader models/weights/posterior $(PLACE_TEXTS) --out models/weights/posterior

refit: towns  ## fit the likelihood of the posterior again, but keep its reader
	$(BIN)/hereabouts train --method posterior $(FITTED_TO) --reader models/weights/posterior --out models/weights/posterior

evaluate: install  ## measure recall on the east of Helsinki and on Alexanderplatz
	for how in posterior regressor matching none; do \
		$(BIN)/hereabouts evaluate --data models/maps/helsinki.osm.pbf --split test --refine $$how --report reports/helsinki-$$how && \
		$(BIN)/hereabouts evaluate --data models/maps/alexanderplatz.osm.pbf --refine $$how --report reports/alexanderplatz-$$how \
		|| exit 1; \
	done

benchmark: index  ## measure time, memory and latency on this machine
	$(BIN)/hereabouts benchmark --map $(MAP) --index $(INDEX)

web:  ## open the page of the running service
	$(PYTHON) -m webbrowser http://127.0.0.1:$(PORT)/

page: install  ## build the page in app/web/page from its sources (needs Node.js)
	$(BIN)/python -c "import json; from app.main import create_app; from app.settings import Settings; \
		print(json.dumps(create_app(Settings()).openapi()))" > app/web/source/schema.json
	cd app/web/source && npm ci --silent --no-audit --no-fund && npm run --silent types && npm run --silent check \
		&& npm run --silent build

check-page: install  ## check that the committed page matches its sources
	committed=$$(mktemp -d) && cp -r app/web/page app/web/source/src $$committed && $(MAKE) page \
		&& diff -r $$committed/page app/web/page && diff -r $$committed/src app/web/source/src \
		|| { echo "app/web/page does not match app/web/source: run make page and commit the result"; exit 1; }

wheels: install  ## download this machine's build of torch for `make image`
	$(BIN)/pip download --quiet --no-deps --dest docker/wheels $(TORCH)

image:  ## build the container image
	docker build --file docker/Dockerfile --tag $(IMAGE) .

clean:  ## remove everything that was built
	rm -rf $(VENV) data reports runs
